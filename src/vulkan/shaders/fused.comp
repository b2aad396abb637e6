#version 450
// Runs lists of commands in one dispatch, one list per workgroup: whole frames of small cloths, or passes of coarse
// levels that are too small for a dispatch each. The commands of a list are contiguous in memory.
#extension GL_GOOGLE_include_directive : require
#define WEFT_SHARED_POINTS
#define WEFT_LINE_ROWS_ID 5
#include "vulkan/shaders/workgroup_barrier.glsl"
#include "vulkan/shaders/common.glsl"
#include "vulkan/shaders/cover.glsl"
#include "vulkan/shaders/faces.glsl"
#include "vulkan/shaders/grabs.glsl"
#include "vulkan/shaders/levels.glsl"
#include "vulkan/shaders/limits.glsl"
#include "vulkan/shaders/lines.glsl"
#include "vulkan/shaders/level_limits.glsl"
#include "vulkan/shaders/particles.glsl"
#include "vulkan/shaders/rows.glsl"
#include "vulkan/shaders/targets.glsl"
#include <shader_ids.glsl>

// One bit per shader that the lists use. The compiler removes the others, which would take registers.
layout(constant_id = 1) const uint used_low = 0xffffffffu;
layout(constant_id = 2) const uint used_middle = 0xffffffffu;
layout(constant_id = 6) const uint used_high = 0xffffffffu;
bool uses(uint id)
{
    uint word = id < 32u ? used_low : id < 64u ? used_middle : used_high;
    return ((word >> (id & 31u)) & 1u) != 0u;
}

struct ListIn {
    uvec2 commands;
    uint count;
    uint points;      // particles to keep in shared memory
    uvec2 position;   // their address
    uvec2 sums;       // fixed-point sums to keep in shared memory, initially 0; 0: none
    uint repeat_begin;  // commands of a substep, which run `times` times
    uint repeat_end;
    uint times;
    uint unused;
};
layout(buffer_reference, std430, buffer_reference_align = 8) readonly buffer ListRef { ListIn at[]; };
layout(push_constant) uniform Push { ListRef lists; uint first; uint substep; };

#define WEFT_COMMAND_BYTES 144u

uvec2 advanced(uvec2 address, uint bytes)
{
    uint carry;
    uint low = uaddCarry(address.x, bytes, carry);
    return uvec2(low, address.y + carry);
}

// Solves as many blocks at once as shared memory has room for.
void run_all_lines()
{
    for (uint b = 0u; b < line_args.at.count;) {
        uint base = first_row_of(b), end = b + 1u;
        while (end < line_args.at.count && (shared_line_rows == 1u || row_after_block(end) - base <= shared_line_rows))
            ++end;
        if (b > 0u) workgroup_barrier();
        run_lines(LineRound(b, end, base));
        b = end;
    }
}

#define WEFT_EACH(name)                                                   \
    case WEFT_ID_##name:                                                  \
        if (uses(WEFT_ID_##name))                                         \
            for (uint i = me; i < invocations; i += all) run_##name(i);   \
        break;

#define WEFT_EACH_ROW(id, pass)                                                             \
    case id:                                                                                \
        if (uses(id)) {                                                                     \
            for (uint i = me; i < invocations; i += all) {                                  \
                RowRange rows = rows_of(i);                                                 \
                for (uint k = 0u; k < rows.count; ++k) pass(rows.row + k * rows.stride);    \
            }                                                                               \
        }                                                                                   \
        break;

// Macros by the source of the constraints and by their damping (constraints.def).
#define WEFT_EACH_OF_MODEL(name)                          \
    WEFT_EACH_ROW(WEFT_ID_plain_##name, plain_row_##name) \
    WEFT_EACH_ROW(WEFT_ID_side_by_side_##name, side_by_side_row_##name)
#define WEFT_EACH_fabric(name) WEFT_EACH_OF_MODEL(name)
#define WEFT_EACH_pins(name) WEFT_EACH_OF_MODEL(name)
#define WEFT_EACH_level(name)
#define WEFT_EACH_links(name) WEFT_EACH_ROW(WEFT_ID_plain_##name, plain_row_##name)
#define WEFT_EACH_dynamic(name) WEFT_EACH_ROW(WEFT_ID_side_by_side_##name, side_by_side_row_##name)
#define WEFT_EACH_damped(name) WEFT_EACH_ROW(WEFT_ID_damp_##name, damp_row_##name)
#define WEFT_EACH_undamped(name)

void run_command(uint me, uint all)
{
    uint invocations = CommandRef(command).invocations;
    switch (CommandRef(command).program) {
    WEFT_EACH(predict)
    WEFT_EACH(velocities)
    WEFT_EACH(advance)
    WEFT_EACH(targets)
    WEFT_EACH(hide_grabs)
    WEFT_EACH(hold_grabs)
    WEFT_EACH(grab)
    WEFT_EACH(free_grabs)
    WEFT_EACH(average)
    WEFT_EACH_ROW(WEFT_ID_weigh_taut, weigh_taut_row)
    WEFT_EACH(couple)
    WEFT_EACH(steady)
    WEFT_EACH(release)
    WEFT_EACH(take_taut)
    WEFT_EACH(free_taut)
    WEFT_EACH(cover)
    WEFT_EACH(contact)
    WEFT_EACH(keep)
    WEFT_EACH(check)
    WEFT_EACH(roll_back)
    WEFT_EACH(restriction)
    WEFT_EACH(interpolation)
    WEFT_EACH(node_correction)
    WEFT_EACH(prolongation)
    WEFT_EACH(wind)
    WEFT_EACH(air)
    WEFT_EACH(faces)
    WEFT_EACH(smooth_faces)
    WEFT_EACH(push)
    WEFT_EACH(normals)
    case WEFT_ID_lines:
        if (uses(WEFT_ID_lines)) run_all_lines();
        break;
    case WEFT_ID_level_limits:
        if (uses(WEFT_ID_level_limits)) run_level_limits();
        break;
    case WEFT_ID_limits:
        if (uses(WEFT_ID_limits)) run_limits();
        break;
#define WEFT_CONSTRAINT(name, Name, arity, moved, lambdas, source, damping) \
    WEFT_EACH_ROW(WEFT_ID_project_##name, project_row_##name)               \
    WEFT_EACH_##source(name)                                                \
    WEFT_EACH_##damping(name)
#include "physics/constraints.def"
#undef WEFT_CONSTRAINT
    }
}

void main()
{
    uint me = gl_LocalInvocationID.x, all = gl_WorkGroupSize.x;
    ListIn list = lists.at[first + gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x];
    if (shared_points > 1u) {
        Vec4s from = Vec4s(list.position);
        for (uint p = me; p < list.points; p += all) points[p] = from.at[p];
        home_of_points = list.position;
    }
    if (shared_quanta > 1u) {
        for (uint i = me; i < list.points * WEFT_QUANTA_PER_POINT; i += all) quanta[i] = 0u;
        home_of_sums = list.sums;
    }
    uint round = 0u;
    for (uint c = 0u; c < list.count;) {
        command = advanced(list.commands, c * WEFT_COMMAND_BYTES);
        if (CommandRef(command).needs_barrier != 0u || c == 0u) workgroup_barrier();
        substeps_before = substep + (c >= list.repeat_begin && c < list.repeat_end ? round : 0u);
        run_command(me, all);
        ++c;
        if (c == list.repeat_end && round + 1u < list.times) {
            c = list.repeat_begin;
            ++round;
        }
    }
    if (shared_points > 1u) {
        workgroup_barrier();
        Vec4s to = Vec4s(list.position);
        for (uint p = me; p < list.points; p += all) to.at[p] = points[p];
    }
}
