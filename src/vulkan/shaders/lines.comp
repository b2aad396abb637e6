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
    Share share = share_of_workgroup();
    if (is_none(share.command)) return;
    uint block = share.group;
    run_lines(LineArgsRef(share.command),
              LineRound(block, block + 1u, LineArgsRef(share.command).at.blocks.at[2u * block]));
}
