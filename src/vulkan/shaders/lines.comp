#version 450
// Rows of stretch along lines, a block of lines to a workgroup.
#extension GL_GOOGLE_include_directive : require
#define WEFT_LINE_ROWS_ID 1
#include "vulkan/shaders/meet.glsl"
#include "vulkan/shaders/common.glsl"
#include "vulkan/shaders/dispatch.glsl"
#include "vulkan/shaders/lines.glsl"

void main()
{
    if (!find_command()) return;
    uint block = group_of_command;
    // What a dispatch has too many of has nothing to do, but meets the others.
    uint end = min(block + 1u, line_args.at.count);
    uint base = block < line_args.at.count ? line_args.at.blocks.at[2u * block] : 0u;
    run_lines(LineRound(min(block, end), end, base));
}
