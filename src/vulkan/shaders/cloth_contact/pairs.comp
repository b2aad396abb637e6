#version 450
// A pass with one invocation per near pair.
#extension GL_GOOGLE_include_directive : require
#include "vulkan/shaders/cloth_contact/pairs.glsl"

void main() { WEFT_PASS(invocation()); }
