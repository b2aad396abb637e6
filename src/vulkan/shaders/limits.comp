#version 450
// What one-sided rows allow for in this frame. One workgroup.
#extension GL_GOOGLE_include_directive : require
#include "vulkan/shaders/common.glsl"
#include "vulkan/shaders/limits.glsl"

layout(push_constant) uniform Push { LimitArgs args; };

void main()
{
    run_limits(args);
}
