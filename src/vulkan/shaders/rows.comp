#version 450
// Rows of one constraint: WEFT_ROW_PASS is project_row_<name>, plain_row_<name>, side_by_side_row_<name> or
// damp_row_<name>.
#extension GL_GOOGLE_include_directive : require
#include "vulkan/shaders/common.glsl"
#include "vulkan/shaders/dispatch.glsl"
#include "vulkan/shaders/rows.glsl"

void main()
{
    Share share = share_of_workgroup();
    if (is_none(share.command)) return;
    RowRange rows = rows_of(RowArgsRef(share.command), invocation_of(share));
    for (uint k = 0u; k < rows.count; ++k) WEFT_ROW_PASS(RowArgsRef(share.command), rows.row + k * rows.stride);
}
