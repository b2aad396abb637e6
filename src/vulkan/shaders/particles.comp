#version 450
// A pass over particles or what is as simple: WEFT_PASS is its function, WEFT_ARGS what that is told.
#extension GL_GOOGLE_include_directive : require
#include "vulkan/shaders/common.glsl"
#include "vulkan/shaders/particles.glsl"
#include "vulkan/shaders/faces.glsl"
#include "vulkan/shaders/levels.glsl"

layout(push_constant) uniform Push { WEFT_ARGS args; };

void main()
{
    uint i = invocation();
    if (i < args.count) WEFT_PASS(args, i);
}
