// Passes of coarse levels.
#ifndef WEFT_LEVELS_GLSL
#define WEFT_LEVELS_GLSL

#define WEFT_PARENTS 4u  // Carry::parents

vec3 carried(LevelArgsRef a, uint i)
{
    vec3 sum = vec3(0.0);
    for (uint k = 0u; k < WEFT_PARENTS; ++k) {
        uint at = k * a.at.stride + i;
        sum = sum + a.at.coarser.at[a.at.nodes.at[at]].xyz * a.at.weights.at[at];
    }
    return sum;
}

void run_collect(LevelArgsRef a, uint i)
{
    vec3 sum = vec3(0.0);
    uint packet = i / WEFT_LANE_PADDING;
    uint end = a.at.begin.at[packet + 1u];
    for (uint k = a.at.begin.at[packet]; k < end; ++k) {
        uint at = k * WEFT_LANE_PADDING + i % WEFT_LANE_PADDING;
        sum = sum + load_point(a.at.finer, a.at.nodes.at[at]).xyz * a.at.weights.at[at];
    }
    a.at.origin.at[i] = vec4(sum, 0.0);
}

void run_lift(LevelArgsRef a, uint i)
{
    vec3 x = a.at.origin.at[i].xyz;
    if (!is_none(uvec2(a.at.coarser))) x = x + carried(a, i);
    store_point(a.at.position, i, vec4(x, load_point(a.at.position, i).w));
}

void run_settle(LevelArgsRef a, uint i)
{
    a.at.displacement.at[i] = vec4(load_point(a.at.position, i).xyz - a.at.origin.at[i].xyz, 0.0);
}

void run_spread(LevelArgsRef a, uint i)
{
    vec4 x = load_point(a.at.position, i);
    store_point(a.at.position, i, vec4(x.xyz + carried(a, i), x.w));
}

#endif
