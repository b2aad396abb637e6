// Passes over particles one by one.
#ifndef WEFT_PARTICLES_GLSL
#define WEFT_PARTICLES_GLSL

// The fourth floats hold, in this order, the inverse mass and the x, y and z of the velocity that rounding dropped.
Motion load_motion(ParticleArgsRef a, uint p, out vec3 start)
{
    vec4 s = a.at.start.at[p];
    vec4 v = a.at.velocity.at[p];
    vec4 c = a.at.carry.at[p];
    start = s.xyz;
    return Motion(v.xyz, vec3(s.w, v.w, c.w), c.xyz);
}

void store_motion(ParticleArgsRef a, uint p, Motion m)
{
    a.at.velocity.at[p] = vec4(m.v, m.v_dropped.y);
    a.at.carry.at[p] = vec4(m.x_dropped, m.v_dropped.z);
}

vec3 gravity_of(FrameRef frame) { return vec3(frame.at.gravity_x, frame.at.gravity_y, frame.at.gravity_z); }

void report_capped(ParticleArgsRef a, bool capped)
{
    if (capped) atomicOr(a.at.report.at[0], WEFT_REPORT_SPEED_CAPPED);
}

void run_predict(ParticleArgsRef a, uint p)
{
    vec4 x = load_point(a.at.position, p);
    vec3 start;
    Motion m = load_motion(a, p, start);
    start = x.xyz;
    bool capped = predict(x.xyz, m, x.w, gravity_of(a.at.frame), a.at.frame.at.max_speed, substep_of(a.at.frame));
    store_point(a.at.position, p, x);
    a.at.start.at[p] = vec4(start, m.v_dropped.x);
    store_motion(a, p, m);
    report_capped(a, capped);
}

void run_velocities(ParticleArgsRef a, uint p)
{
    vec4 x = load_point(a.at.position, p);
    vec3 start;
    Motion m = load_motion(a, p, start);
    bool capped = update_velocity(m, x.xyz, start, x.w, a.at.frame.at.max_speed, substep_of(a.at.frame));
    store_motion(a, p, m);
    report_capped(a, capped);
}

// The end of one substep and the beginning of the next.
void run_advance(ParticleArgsRef a, uint p)
{
    vec4 x = load_point(a.at.position, p);
    vec3 start;
    Motion m = load_motion(a, p, start);
    Step h = substep_of(a.at.frame);
    bool ended = update_velocity(m, x.xyz, start, x.w, a.at.frame.at.max_speed, h);
    start = x.xyz;
    bool begun = predict(x.xyz, m, x.w, gravity_of(a.at.frame), a.at.frame.at.max_speed, h);
    store_point(a.at.position, p, x);
    a.at.start.at[p] = vec4(start, m.v_dropped.x);
    store_motion(a, p, m);
    report_capped(a, ended || begun);
}

void run_hold(HoldArgsRef a, uint i)
{
    HeldIn held = a.at.held.at[i];
    PoseIn pose = a.at.poses.at[(a.at.substep + substeps_before + 1u) * a.at.frame.at.movers + held.mover];
    vec3 x = rotate(pose.x.xyz, pose.y.xyz, pose.z.xyz, held.local.xyz) + pose.position.xyz;
    store_point(a.at.position, held.particle, vec4(x, load_point(a.at.position, held.particle).w));
}

void run_average(AverageArgsRef a, uint p)
{
    uint begin = a.at.offsets.at[p], end = a.at.offsets.at[p + 1u];
    if (begin == end) return;
    vec3 sum = vec3(0.0);
    if (is_none(uvec2(a.at.sums))) {
        for (uint k = begin; k < end; ++k) sum = sum + a.at.corrections.at[a.at.items.at[k]].xyz;
    } else {
        for (uint axis = 0u; axis < 3u; ++axis) sum[axis] = from_quanta(float(int(take_sum(a.at.sums, p, axis))));
    }
    if (a.at.mean == 1u) sum = sum * (1.0 / float(end - begin));
    vec4 x = load_point(a.at.position, p);
    store_point(a.at.position, p, vec4(x.xyz + sum, x.w));
}

// Adds what a contact did to the particle's account of the frame, which the first contacts of the frame begin.
void trace(ContactArgsRef a, uint collider, uint p, bool touches, vec3 before, vec3 x, vec3 position)
{
    bool begins = a.at.substep + substeps_before == 0u && a.at.first_iteration == 1u;
    if (!touches && !begins) return;
    uint at = collider * a.at.capacity + p, turned = a.at.frame.at.colliders * a.at.capacity + at;
    ContactTrace sum = ContactTrace(vec3(0.0), vec3(0.0));
    if (!begins) sum = ContactTrace(a.at.felt.at[at].xyz, a.at.felt.at[turned].xyz);
    if (touches) trace_contact(sum, before, x, position);
    a.at.felt.at[at] = vec4(sum.moved, 0.0);
    a.at.felt.at[turned] = vec4(sum.turned, 0.0);
}

void run_contact(ContactArgsRef a, uint p)
{
    vec4 x = load_point(a.at.position, p);
    vec3 start = a.at.start.at[p].xyz;
    uint colliders = a.at.frame.at.colliders, substep = a.at.substep + substeps_before;
    bool keeps = !is_none(uvec2(a.at.sums)), traces = !is_none(uvec2(a.at.felt));
    for (uint c = 0u; c < colliders; ++c) {
        ColliderIn collider = a.at.colliders.at[c];
        PoseIn now = a.at.poses.at[(substep + 1u) * colliders + c];
        PoseIn before = a.at.poses.at[substep * colliders + c];
        ContactBody body = ContactBody(now.x.xyz, now.y.xyz, now.z.xyz, now.position.xyz, before.x.xyz, before.y.xyz,
                                       before.z.xyz, before.position.xyz, collider.static_friction,
                                       collider.kinetic_friction, a.at.frame.at.half_thickness, a.at.frame.at.depenetration);
        ShapeNumbers shape = ShapeNumbers(collider.numbers.x, collider.numbers.y, collider.numbers.z, collider.numbers.w);
        uint at = c * a.at.capacity + p;
        ContactSum sum = ContactSum(vec3(0.0), 0.0);
        if (keeps && a.at.first_iteration == 0u) {
            vec4 kept = a.at.sums.at[at];
            sum = ContactSum(kept.xyz, kept.w);
        }
        vec3 local = to_body(body, x.xyz);
        vec3 normal, normal_at_start;
        float gap = 0.0, gap_at_start = 0.0;
        uint kind = 0u;
#define WEFT_SHAPE(name, Name) if (collider.shape == kind++) gap = distance_##name(local, shape, normal);
#include "physics/contact/shapes.def"
#undef WEFT_SHAPE
        gap = gap - body.half_thickness;
        vec3 x_before = x.xyz;
        bool touches = gap < 0.0 || sum.push > 0.0;
        if (touches) {
            vec3 local_at_start = to_body_at_start(body, start);
            kind = 0u;
#define WEFT_SHAPE(name, Name) \
    if (collider.shape == kind++) gap_at_start = distance_##name(local_at_start, shape, normal_at_start);
#include "physics/contact/shapes.def"
#undef WEFT_SHAPE
            gap_at_start = gap_at_start - body.half_thickness;
            project_contact(x.xyz, start, x.w, sum, gap, gap_at_start, rotate(body.rx, body.ry, body.rz, normal),
                            carried_by(body, local), body);
        }
        if (keeps) a.at.sums.at[at] = vec4(sum.friction, sum.push);
        if (traces) trace(a, c, p, touches, x_before, x.xyz, body.position);
    }
    store_point(a.at.position, p, x);
}

// What the frame found, to go back to.
void run_keep(KeepArgsRef a, uint p)
{
    a.at.good_position.at[p] = vec4(load_point(a.at.position, p).xyz, a.at.start.at[p].w);
    a.at.good_velocity.at[p] = a.at.velocity.at[p];
    a.at.good_carry.at[p] = a.at.carry.at[p];
}

void run_check(KeepArgsRef a, uint p)
{
    if (!is_finite(load_point(a.at.position, p)) || !is_finite(a.at.velocity.at[p]) || !is_finite(a.at.carry.at[p]))
        atomicOr(a.at.report.at[0], WEFT_REPORT_NON_FINITE);
}

void run_roll_back(KeepArgsRef a, uint i)
{
    if ((a.at.report.at[0] & WEFT_REPORT_NON_FINITE) == 0u) return;
    // What was solved was not of this place; a residual and a saved state still read it.
    if (i < a.at.lambdas) a.at.lambda.at[i] = 0.0;
    if (i >= a.at.count) return;
    vec4 good = a.at.good_position.at[i];
    a.at.start.at[i] = good;
    store_point(a.at.position, i, vec4(good.xyz, a.at.weights.at[i]));
    a.at.velocity.at[i] = a.at.good_velocity.at[i];
    a.at.carry.at[i] = a.at.good_carry.at[i];
}

#endif
