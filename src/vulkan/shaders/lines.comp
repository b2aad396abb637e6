#version 450
// Stretch constraints along lines, one block of lines per workgroup.
#extension GL_GOOGLE_include_directive : require
#define WEFT_LINE_ROWS_ID 1
#include "vulkan/shaders/workgroup_barrier.glsl"
#include "vulkan/shaders/common.glsl"
#include "vulkan/shaders/dispatch.glsl"
#include "vulkan/shaders/lines.glsl"

void main()
{
    if (!find_command()) return;
    uint block = group_of_command;
    // Workgroups after the last block have no work but reach the same barriers.
    uint end = min(block + 1u, line_args.at.count);
    uint base = block < line_args.at.count ? line_args.at.blocks.at[2u * block] : 0u;
    run_lines(LineRound(min(block, end), end, base));
}
