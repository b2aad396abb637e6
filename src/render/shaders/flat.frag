#version 460
#include "render/shaders/common.glsl"

layout(location = 0) in vec4 color;
layout(location = 0) out vec4 result;

void main() { result = vec4(srgb_decoded(color.rgb), color.a); }
