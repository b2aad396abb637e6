// Passes of coarse levels.
#ifndef WEFT_LEVELS_GLSL
#define WEFT_LEVELS_GLSL

#define WEFT_PARENTS 4u  // Prolongation::parents

vec3 interpolated(uint i)
{
    vec3 sum = vec3(0.0);
    for (uint k = 0u; k < WEFT_PARENTS; ++k) {
        uint at = k * level_args.at.stride + i;
        sum = sum + level_args.at.coarser.at[level_args.at.nodes.at[at]].xyz * level_args.at.weights.at[at];
    }
    return sum;
}

void run_restriction(uint i)
{
    vec3 sum = vec3(0.0);
    uint packet = i / WEFT_LANE_PADDING;
    uint end = level_args.at.begin.at[packet + 1u];
    for (uint k = level_args.at.begin.at[packet]; k < end; ++k) {
        uint at = k * WEFT_LANE_PADDING + i % WEFT_LANE_PADDING;
        sum = sum + load_point(level_args.at.finer, level_args.at.nodes.at[at]).xyz * level_args.at.weights.at[at];
    }
    level_args.at.origin.at[i] = vec4(sum, 0.0);
}

void run_interpolation(uint i)
{
    vec3 x = level_args.at.origin.at[i].xyz, remainder = vec3(0.0);
    if (!is_none(uvec2(level_args.at.coarser))) move_exactly(x, remainder, interpolated(i));
    if (!is_none(uvec2(level_args.at.remainder))) level_args.at.remainder.at[i] = vec4(remainder, 0.0);
    store_point(level_args.at.position, i, vec4(x, load_point(level_args.at.position, i).w));
}

void run_node_correction(uint i)
{
    vec3 moved = load_point(level_args.at.position, i).xyz - level_args.at.origin.at[i].xyz;
    if (!is_none(uvec2(level_args.at.remainder))) moved = moved + level_args.at.remainder.at[i].xyz;
    level_args.at.displacement.at[i] = vec4(moved, 0.0);
}

void run_prolongation(uint i)
{
    vec4 x = load_point(level_args.at.position, i);
    // The weights of the levels may be older than a pin, so a pinned particle may have a displacement.
    float moves = x.w > 0.0 ? 1.0 : 0.0;
    move_point(level_args.at.position, level_args.at.remainder, i, x, interpolated(i) * moves);
}

#endif
