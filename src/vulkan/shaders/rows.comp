#version 450
// A pass over the constraints of one kind: WEFT_ROW_PASS is project_row_<name>, plain_row_<name>,
// side_by_side_row_<name> or damp_row_<name>.
#extension GL_GOOGLE_include_directive : require
#include "vulkan/shaders/common.glsl"
#include "vulkan/shaders/dispatch.glsl"
#include "vulkan/shaders/rows.glsl"

void main()
{
    if (!find_command()) return;
    RowRange rows = rows_of(invocation_of_command());
    for (uint k = 0u; k < rows.count; ++k) WEFT_ROW_PASS(rows.row + k * rows.stride);
}
