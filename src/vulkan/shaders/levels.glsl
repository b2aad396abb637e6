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

uint pinned_particle(uint node)
{
    if (is_none(uvec2(level_args.at.pinned))) return WEFT_NOT_PINNED;
    return level_args.at.pinned.at[node];
}

void run_restriction(uint i)
{
    vec3 sum = vec3(0.0);
    float ratio = 0.0;
    bool heavy = level_args.at.heavy != 0u;
    bool of_particles = !is_none(uvec2(level_args.at.particle_weight));
    uint packet = i / WEFT_LANE_PADDING;
    uint end = level_args.at.begin.at[packet + 1u];
    for (uint k = level_args.at.begin.at[packet]; k < end; ++k) {
        uint at = k * WEFT_LANE_PADDING + i % WEFT_LANE_PADDING;
        uint node = level_args.at.nodes.at[at];
        vec4 point = load_point(level_args.at.finer, node);
        float part = level_args.at.weights.at[at];
        sum = sum + point.xyz * part;
        if (of_particles) point.w = mass_ratio(point.w, level_args.at.particle_weight.at[node]);
        if (heavy) ratio = ratio + point.w * part;
    }
    level_args.at.origin.at[i] = vec4(sum, ratio);
}

void run_interpolation(uint i)
{
    vec4 origin = level_args.at.origin.at[i];
    vec3 x = origin.xyz, remainder = vec3(0.0);
    if (!is_none(uvec2(level_args.at.coarser))) move_exactly(x, remainder, interpolated(i));
    if (!is_none(uvec2(level_args.at.remainder))) level_args.at.remainder.at[i] = vec4(remainder, 0.0);
    vec4 point = vec4(x, level_args.at.node_weight.at[i]);
    if (level_args.at.heavy != 0u) point.w = point.w / max(origin.w, 1.0);
    // Attached points have masses in the level, and begin where coarser levels have moved them.
    uint pinned = pinned_particle(i);
    if (pinned != WEFT_NOT_PINNED) {
        vec4 particle = load_point(level_args.at.particles, pinned);
        if (particle.w < 0.0) {
            point = vec4(particle.xyz, -particle.w);
            level_args.at.origin.at[i] = vec4(particle.xyz, 0.0);
        }
    }
    store_point(level_args.at.position, i, point);
}

void run_node_correction(uint i)
{
    vec4 point = load_point(level_args.at.position, i);
    vec3 moved = point.xyz - level_args.at.origin.at[i].xyz;
    if (!is_none(uvec2(level_args.at.remainder))) moved = moved + level_args.at.remainder.at[i].xyz;
    // The particle moves as far as its node. Nodes near it do not: its mass is that of the body, not of cloth.
    uint pinned = pinned_particle(i);
    if (pinned != WEFT_NOT_PINNED && point.w > 0.0) {
        float weight = load_point(level_args.at.particles, pinned).w;
        store_point(level_args.at.particles, pinned, vec4(point.xyz, weight));
        moved = vec3(0.0);
    }
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
