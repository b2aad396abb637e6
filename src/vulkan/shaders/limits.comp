#version 450
// Slack of the one-sided constraints in this frame. One workgroup per cloth.
#extension GL_GOOGLE_include_directive : require
#include "vulkan/shaders/common.glsl"
#include "vulkan/shaders/dispatch.glsl"
#include "vulkan/shaders/limits.glsl"

void main()
{
    if (find_command()) run_limits();
}
