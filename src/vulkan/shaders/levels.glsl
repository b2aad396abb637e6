// Passes of coarse levels.
#ifndef WEFT_LEVELS_GLSL
#define WEFT_LEVELS_GLSL

#define WEFT_PARENTS 4u  // Carry::parents

vec3 carried(LevelArgs a, uint i)
{
    vec3 sum = vec3(0.0);
    for (uint k = 0u; k < WEFT_PARENTS; ++k) {
        uint at = k * a.stride + i;
        sum = sum + a.coarser.at[a.nodes.at[at]].xyz * a.weights.at[at];
    }
    return sum;
}

void run_collect(LevelArgs a, uint i)
{
    vec3 sum = vec3(0.0);
    uint packet = i / WEFT_LANE_PADDING;
    uint end = a.begin.at[packet + 1u];
    for (uint k = a.begin.at[packet]; k < end; ++k) {
        uint at = k * WEFT_LANE_PADDING + i % WEFT_LANE_PADDING;
        sum = sum + load_point(a.finer, a.nodes.at[at]).xyz * a.weights.at[at];
    }
    a.origin.at[i] = vec4(sum, 0.0);
}

void run_lift(LevelArgs a, uint i)
{
    vec3 x = a.origin.at[i].xyz;
    if (!is_none(uvec2(a.coarser))) x = x + carried(a, i);
    store_point(a.position, i, vec4(x, load_point(a.position, i).w));
}

void run_settle(LevelArgs a, uint i)
{
    a.displacement.at[i] = vec4(load_point(a.position, i).xyz - a.origin.at[i].xyz, 0.0);
}

void run_spread(LevelArgs a, uint i)
{
    vec4 x = load_point(a.position, i);
    store_point(a.position, i, vec4(x.xyz + carried(a, i), x.w));
}

#endif
