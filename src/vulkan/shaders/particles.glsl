// Passes over single particles.
#ifndef WEFT_PARTICLES_GLSL
#define WEFT_PARTICLES_GLSL

// The fourth floats of position, start, velocity and compensation hold, in this order, the inverse mass and the x, y
// and z of the velocity's compensation.
Motion load_motion(uint p, out vec3 start)
{
    vec4 s = particle_args.at.start.at[p];
    vec4 v = particle_args.at.velocity.at[p];
    vec4 c = particle_args.at.compensation.at[p];
    start = s.xyz;
    return Motion(v.xyz, vec3(s.w, v.w, c.w), c.xyz);
}

void store_motion(uint p, Motion m)
{
    particle_args.at.velocity.at[p] = vec4(m.v, m.v_dropped.y);
    particle_args.at.compensation.at[p] = vec4(m.x_dropped, m.v_dropped.z);
}

// Cloth near pins falls more slowly.
vec3 felt_at(uint p, vec3 acceleration)
{
    return is_none(uvec2(particle_args.at.steady_parts)) ? acceleration : acceleration * particle_args.at.steady_parts.at[p];
}

// The end of a substep. Leaves the remainder at zero.
bool end_motion(uint p, inout Motion m, vec3 x, vec3 start, float w)
{
    Step h = substep_of(particle_args.at.frame);
    if (is_none(uvec2(particle_args.at.remainder)))
        return update_velocity(m, x, start, w, particle_args.at.frame.at.max_speed, h);
    vec3 remainder = particle_args.at.remainder.at[p].xyz;
    particle_args.at.remainder.at[p] = vec4(0.0);
    return update_velocity_exactly(m, x, remainder, start, w, particle_args.at.frame.at.max_speed, h);
}

void report_capped(bool capped)
{
    if (capped) atomicOr(particle_args.at.report.at[0], WEFT_REPORT_SPEED_CAPPED);
}

void run_predict(uint p)
{
    vec4 x = load_point(particle_args.at.position, p);
    vec3 start;
    Motion m = load_motion(p, start);
    start = x.xyz;
    bool capped = predict(x.xyz, m, x.w, felt_at(p, gravity_of(particle_args.at.frame)), particle_args.at.frame.at.max_speed,
                          substep_of(particle_args.at.frame));
    store_point(particle_args.at.position, p, x);
    particle_args.at.start.at[p] = vec4(start, m.v_dropped.x);
    store_motion(p, m);
    report_capped(capped);
}

void run_velocities(uint p)
{
    vec4 x = load_point(particle_args.at.position, p);
    vec3 start;
    Motion m = load_motion(p, start);
    bool capped = end_motion(p, m, x.xyz, start, x.w);
    if (!is_none(uvec2(particle_args.at.remainder))) particle_args.at.start.at[p] = vec4(start, m.v_dropped.x);
    store_motion(p, m);
    report_capped(capped);
}

// The end of one substep and the beginning of the next.
void run_advance(uint p)
{
    vec4 x = load_point(particle_args.at.position, p);
    vec3 start;
    Motion m = load_motion(p, start);
    Step h = substep_of(particle_args.at.frame);
    bool ended = end_motion(p, m, x.xyz, start, x.w);
    start = x.xyz;
    bool begun = predict(x.xyz, m, x.w, felt_at(p, gravity_of(particle_args.at.frame)), particle_args.at.frame.at.max_speed, h);
    store_point(particle_args.at.position, p, x);
    particle_args.at.start.at[p] = vec4(start, m.v_dropped.x);
    store_motion(p, m);
    report_capped(ended || begun);
}

// Makes particles near pins heavier until run_release().
void run_steady(uint p)
{
    float part = steady_part(steady_args.at.steadiness.at[p], steady_args.at.weights.at[steady_args.at.pins.at[p]],
                             substep_of(steady_args.at.frame));
    steady_args.at.parts.at[p] = part;
    store_point(steady_args.at.position, p,
                vec4(load_point(steady_args.at.position, p).xyz, steady_args.at.weights.at[p] * part));
}

void run_release(uint p)
{
    store_point(steady_args.at.position, p,
                vec4(load_point(steady_args.at.position, p).xyz, steady_args.at.weights.at[p]));
}

// Adds the masses of its taut edges to a particle, and leaves the sums at zero.
void run_take_taut(uint p)
{
    vec4 sum = taut_args.at.sums.at[p], x = load_point(taut_args.at.position, p);
    take_taut_mass(x.xyz, x.w, taut_args.at.start.at[p].xyz, TautSum(sum.xyz, sum.w));
    store_point(taut_args.at.position, p, x);
    taut_args.at.sums.at[p] = vec4(0.0);
}

void run_free_taut(uint p)
{
    store_point(taut_args.at.position, p, vec4(load_point(taut_args.at.position, p).xyz, taut_args.at.weights.at[p]));
}

void run_average(uint p)
{
    uint begin = average_args.at.offsets.at[p], end = average_args.at.offsets.at[p + 1u];
    if (begin == end) return;
    vec3 sum = vec3(0.0);
    if (is_none(uvec2(average_args.at.sums))) {
        for (uint k = begin; k < end; ++k) sum = sum + average_args.at.corrections.at[average_args.at.items.at[k]].xyz;
    } else {
        for (uint axis = 0u; axis < 3u; ++axis)
            sum[axis] = from_quanta(float(int(take_sum(average_args.at.sums, p, axis))));
    }
    if (average_args.at.mean == 1u) sum = sum * (1.0 / float(end - begin));
    vec4 x = load_point(average_args.at.position, p);
    move_point(average_args.at.position, average_args.at.remainder, p, x, sum);
}

float coupled_moment(uint row) { return -(couple_args.at.lambda.at[row] * couple_args.at.frame.at.inv_h2); }

// Moves the rest angle of a constraint by the moments of its triangles.
void run_couple(uint r)
{
    uint stride = couple_args.at.stride;
    float moment = coupled_moment(r), rate = couple_args.at.numbers.at[6u * stride + r];
    for (uint side = 0u; side < 2u; ++side) {
        float other[2], by[3];
        for (uint k = 0u; k < 2u; ++k)
            other[k] = coupled_moment(couple_args.at.rows.at[(2u * side + k) * stride + r]);
        for (uint k = 0u; k < 3u; ++k) by[k] = couple_args.at.numbers.at[(3u * side + k) * stride + r];
        float shift = couple_args.at.shifts.at[side * stride + r];
        couple_args.at.shifts.at[side * stride + r] =
            shift_moment(shift, moment, other[0], other[1], by[0], by[1], by[2], rate);
    }
}

// Saves the state at the beginning of the frame, for run_roll_back().
void run_keep(uint p)
{
    if (!is_none(uvec2(keep_args.at.good_kept)) && p < keep_args.at.kept_count)
        keep_args.at.good_kept.at[p] = keep_args.at.kept.at[p];
    if (p >= keep_args.at.count) return;
    keep_args.at.good_position.at[p] = vec4(load_point(keep_args.at.position, p).xyz, keep_args.at.start.at[p].w);
    keep_args.at.good_velocity.at[p] = keep_args.at.velocity.at[p];
    keep_args.at.good_compensation.at[p] = keep_args.at.compensation.at[p];
    if (p == 0u) keep_args.at.report.at[WEFT_REPORT_NEAR_SLOTS] = 0u;
}

void run_check(uint p)
{
    if (!is_finite(load_point(keep_args.at.position, p)) || !is_finite(keep_args.at.velocity.at[p]) ||
        !is_finite(keep_args.at.compensation.at[p]))
        atomicOr(keep_args.at.island_report.at[0], WEFT_REPORT_NON_FINITE);
}

void run_roll_back(uint i)
{
    uint report = keep_args.at.island_report.at[0];
    if ((report & (WEFT_REPORT_NON_FINITE | WEFT_REPORT_LIST_FULL)) == 0u) return;
    // Lambda does not match the restored positions. Residuals and saved states still read it, and the frame that runs
    // again may read that of the frame before.
    if (i < keep_args.at.kept_count) {
        bool shift = i >= keep_args.at.first_shift, again = (report & WEFT_REPORT_LIST_FULL) != 0u;
        float kept = shift ? keep_args.at.kept.at[i] : 0.0;
        if ((shift || again) && !is_none(uvec2(keep_args.at.good_kept))) kept = keep_args.at.good_kept.at[i];
        keep_args.at.kept.at[i] = kept;
    }
    if (i >= keep_args.at.count) return;
    vec4 good = keep_args.at.good_position.at[i];
    keep_args.at.start.at[i] = good;
    store_point(keep_args.at.position, i, vec4(good.xyz, keep_args.at.weights.at[i]));
    keep_args.at.velocity.at[i] = keep_args.at.good_velocity.at[i];
    keep_args.at.compensation.at[i] = keep_args.at.good_compensation.at[i];
    if (!is_none(uvec2(keep_args.at.remainder))) keep_args.at.remainder.at[i] = vec4(0.0);
}

#endif
