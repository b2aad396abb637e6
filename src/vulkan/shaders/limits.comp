#version 450
// What one-sided rows allow for in this frame. One workgroup to a cloth.
#extension GL_GOOGLE_include_directive : require
#include "vulkan/shaders/common.glsl"
#include "vulkan/shaders/dispatch.glsl"
#include "vulkan/shaders/limits.glsl"

void main()
{
    if (find_command()) run_limits();
}
