#version 460
#extension GL_GOOGLE_include_directive : require
// Areas of one color.
#include "output.glsl"

layout(location = 1) in vec4 color;
layout(location = 0) out vec4 result;

void main() { result = for_target(color); }
