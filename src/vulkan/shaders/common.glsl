// Common start of all shaders: the kernels, the arguments, and the index of the invocation.
#ifndef WEFT_COMMON_GLSL
#define WEFT_COMMON_GLSL

#include "vulkan/args.data.h"

#include "physics/kernels.glsl"

#include "vulkan/shaders/commands.glsl"

layout(local_size_x_id = 0) in;

// A dispatch of more workgroups than fit along x continues along y.
uint invocation()
{
    return (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
}

bool is_none(uvec2 address) { return address == uvec2(0u); }

// Access to a particle or node with its inverse mass. If one workgroup runs a whole frame, it may keep its particles in
// shared memory.
#ifdef WEFT_SHARED_POINTS
layout(constant_id = 3) const uint shared_points = 1u;   // 1: none
shared vec4 points[shared_points];
uvec2 home_of_points = uvec2(0u);

vec4 load_point(Vec4s array, uint p)
{
    if (shared_points > 1u && uvec2(array) == home_of_points) return points[p];
    return array.at[p];
}
void store_point(Vec4s array, uint p, vec4 point)
{
    if (shared_points > 1u && uvec2(array) == home_of_points) points[p] = point;
    else array.at[p] = point;
}

// Sums of the constraints' corrections of a particle, in fixed point: x, y and z.
#define WEFT_QUANTA_PER_POINT 3u
layout(constant_id = 4) const uint shared_quanta = 1u;   // 1: none
shared uint quanta[shared_quanta];
uvec2 home_of_sums = uvec2(0u);
bool sums_are_shared(Uints sums) { return shared_quanta > 1u && uvec2(sums) == home_of_sums; }

void add_to_sum(Uints sums, uint p, uint axis, uint change)
{
    if (sums_are_shared(sums)) atomicAdd(quanta[WEFT_QUANTA_PER_POINT * p + axis], change);
    else atomicAdd(sums.at[4u * p + axis], change);
}
uint take_sum(Uints sums, uint p, uint axis)
{
    uint sum = 0u;
    if (sums_are_shared(sums)) {
        sum = quanta[WEFT_QUANTA_PER_POINT * p + axis];
        quanta[WEFT_QUANTA_PER_POINT * p + axis] = 0u;
    } else {
        sum = sums.at[4u * p + axis];
        sums.at[4u * p + axis] = 0u;
    }
    return sum;
}
#else
vec4 load_point(Vec4s array, uint p) { return array.at[p]; }
void store_point(Vec4s array, uint p, vec4 point) { array.at[p] = point; }
void add_to_sum(Uints sums, uint p, uint axis, uint change) { atomicAdd(sums.at[4u * p + axis], change); }
uint take_sum(Uints sums, uint p, uint axis)
{
    uint sum = sums.at[4u * p + axis];
    sums.at[4u * p + axis] = 0u;
    return sum;
}
#endif

// Moves a particle from `x`. `remainder`: what rounding drops, per particle; 0: not kept.
void move_point(Vec4s position, Vec4s remainder, uint p, vec4 x, vec3 by)
{
    if (is_none(uvec2(remainder))) {
        x.xyz = x.xyz + by;
    } else {
        vec3 kept = remainder.at[p].xyz;
        move_exactly(x.xyz, kept, by);
        remainder.at[p] = vec4(kept, 0.0);
    }
    store_point(position, p, x);
}

vec3 gravity_of(FrameRef frame) { return vec3(frame.at.gravity_x, frame.at.gravity_y, frame.at.gravity_z); }

Step substep_of(FrameRef frame)
{
    return step_without_limits(frame.at.h, frame.at.inv_h, frame.at.inv_h2);
}

Step substep_with(FrameRef frame, LimitsRef limits)
{
    Step step = substep_of(frame);
    step.tension = limits.at.tension, step.allowed = limits.at.allowed;
    return step;
}

// A step in which every constraint is rigid: compliance times inv_h2 is 0.
Step rigid_step(LimitsRef limits)
{
    Step step = step_without_limits(1e3, 1e-3, 0.0);
    step.tension = limits.at.tension, step.allowed = limits.at.allowed;
    return step;
}

// Tests the bits, because a driver may assume that no number is a NaN.
bool is_finite(float x) { return (floatBitsToUint(x) & 0x7f800000u) != 0x7f800000u; }
bool is_finite(vec4 v) { return is_finite(v.x) && is_finite(v.y) && is_finite(v.z) && is_finite(v.w); }

#define WEFT_LANE_PADDING 16u  // lane_padding

#define WEFT_REPORT_SPEED_CAPPED 1u
#define WEFT_REPORT_NON_FINITE 2u
#define WEFT_REPORT_LIST_FULL 0x80000000u
#define WEFT_REPORT_NEAR_FULL 0x40000000u  // report_near_full

#endif
