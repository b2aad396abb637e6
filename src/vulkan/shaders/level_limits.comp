#version 450
// All constraints of a coarse level with few nodes. One workgroup per cloth.
#extension GL_GOOGLE_include_directive : require
#define WEFT_SHARED_NODES_ID 1
#include "vulkan/shaders/workgroup_barrier.glsl"
#include "vulkan/shaders/common.glsl"
#include "vulkan/shaders/dispatch.glsl"
#include "vulkan/shaders/level_limits.glsl"

void main()
{
    if (find_command()) run_level_limits();
}
