#version 450
// Rows of stretch along lines, a block of lines to a workgroup.
#extension GL_GOOGLE_include_directive : require
#define WEFT_LINE_ROWS_ID 1
#include "vulkan/shaders/meet.glsl"
#include "vulkan/shaders/common.glsl"
#include "vulkan/shaders/lines.glsl"

layout(push_constant) uniform Push { LineArgs args; };

void main()
{
    uint block = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    // What a dispatch has too many of has nothing to do, but meets the others.
    uint end = min(block + 1u, args.count);
    uint base = block < args.count ? args.blocks.at[2u * block] : 0u;
    run_lines(args, LineRound(min(block, end), end, base));
}
