// Passes over particles one by one.
#ifndef WEFT_PARTICLES_GLSL
#define WEFT_PARTICLES_GLSL

// The fourth floats hold, in this order, the inverse mass and the x, y and z of the velocity that rounding dropped.
Motion load_motion(ParticleArgs a, uint p, out vec3 start)
{
    vec4 s = a.start.at[p];
    vec4 v = a.velocity.at[p];
    vec4 c = a.carry.at[p];
    start = s.xyz;
    return Motion(v.xyz, vec3(s.w, v.w, c.w), c.xyz);
}

void store_motion(ParticleArgs a, uint p, Motion m)
{
    a.velocity.at[p] = vec4(m.v, m.v_dropped.y);
    a.carry.at[p] = vec4(m.x_dropped, m.v_dropped.z);
}

vec3 gravity_of(FrameRef frame) { return vec3(frame.at.gravity_x, frame.at.gravity_y, frame.at.gravity_z); }

void report_capped(ParticleArgs a, bool capped)
{
    if (capped) atomicOr(a.report.at[0], WEFT_REPORT_SPEED_CAPPED);
}

void run_predict(ParticleArgs a, uint p)
{
    vec4 x = load_point(a.position, p);
    vec3 start;
    Motion m = load_motion(a, p, start);
    start = x.xyz;
    bool capped = predict(x.xyz, m, x.w, gravity_of(a.frame), a.frame.at.max_speed, substep_of(a.frame));
    store_point(a.position, p, x);
    a.start.at[p] = vec4(start, m.v_dropped.x);
    store_motion(a, p, m);
    report_capped(a, capped);
}

void run_velocities(ParticleArgs a, uint p)
{
    vec4 x = load_point(a.position, p);
    vec3 start;
    Motion m = load_motion(a, p, start);
    bool capped = update_velocity(m, x.xyz, start, x.w, a.frame.at.max_speed, substep_of(a.frame));
    store_motion(a, p, m);
    report_capped(a, capped);
}

// The end of one substep and the beginning of the next.
void run_advance(ParticleArgs a, uint p)
{
    vec4 x = load_point(a.position, p);
    vec3 start;
    Motion m = load_motion(a, p, start);
    Step h = substep_of(a.frame);
    bool ended = update_velocity(m, x.xyz, start, x.w, a.frame.at.max_speed, h);
    start = x.xyz;
    bool begun = predict(x.xyz, m, x.w, gravity_of(a.frame), a.frame.at.max_speed, h);
    store_point(a.position, p, x);
    a.start.at[p] = vec4(start, m.v_dropped.x);
    store_motion(a, p, m);
    report_capped(a, ended || begun);
}

void run_hold(HoldArgs a, uint i)
{
    HeldIn held = a.held.at[i];
    PoseIn pose = a.poses.at[(a.substep + 1u) * a.frame.at.movers + held.mover];
    vec3 x = rotate(pose.x.xyz, pose.y.xyz, pose.z.xyz, held.local.xyz) + pose.position.xyz;
    store_point(a.position, held.particle, vec4(x, load_point(a.position, held.particle).w));
}

void run_average(AverageArgs a, uint p)
{
    uint begin = a.offsets.at[p], end = a.offsets.at[p + 1u];
    if (begin == end) return;
    vec3 sum = vec3(0.0);
    if (is_none(uvec2(a.sums))) {
        for (uint k = begin; k < end; ++k) sum = sum + a.corrections.at[a.items.at[k]].xyz;
    } else {
        for (uint axis = 0u; axis < 3u; ++axis) sum[axis] = from_quanta(float(int(take_sum(a.sums, p, axis))));
    }
    if (a.mean == 1u) sum = sum * (1.0 / float(end - begin));
    vec4 x = load_point(a.position, p);
    store_point(a.position, p, vec4(x.xyz + sum, x.w));
}

// Adds what a contact did to the particle's account of the frame, which the first contacts of the frame begin.
void trace(ContactArgs a, uint collider, uint p, bool touches, vec3 before, vec3 x, vec3 position)
{
    bool begins = a.substep == 0u && a.first_iteration == 1u;
    if (!touches && !begins) return;
    uint at = collider * a.capacity + p, turned = a.frame.at.colliders * a.capacity + at;
    ContactTrace sum = ContactTrace(vec3(0.0), vec3(0.0));
    if (!begins) sum = ContactTrace(a.felt.at[at].xyz, a.felt.at[turned].xyz);
    if (touches) trace_contact(sum, before, x, position);
    a.felt.at[at] = vec4(sum.moved, 0.0);
    a.felt.at[turned] = vec4(sum.turned, 0.0);
}

void run_contact(ContactArgs a, uint p)
{
    vec4 x = load_point(a.position, p);
    vec3 start = a.start.at[p].xyz;
    uint colliders = a.frame.at.colliders;
    bool keeps = !is_none(uvec2(a.sums)), traces = !is_none(uvec2(a.felt));
    for (uint c = 0u; c < colliders; ++c) {
        ColliderIn collider = a.colliders.at[c];
        PoseIn now = a.poses.at[(a.substep + 1u) * colliders + c];
        PoseIn before = a.poses.at[a.substep * colliders + c];
        ContactBody body = ContactBody(now.x.xyz, now.y.xyz, now.z.xyz, now.position.xyz, before.x.xyz, before.y.xyz,
                                       before.z.xyz, before.position.xyz, collider.static_friction,
                                       collider.kinetic_friction, a.frame.at.half_thickness, a.frame.at.depenetration);
        ShapeNumbers shape = ShapeNumbers(collider.numbers.x, collider.numbers.y, collider.numbers.z, collider.numbers.w);
        uint at = c * a.capacity + p;
        ContactSum sum = ContactSum(vec3(0.0), 0.0);
        if (keeps && a.first_iteration == 0u) {
            vec4 kept = a.sums.at[at];
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
        if (keeps) a.sums.at[at] = vec4(sum.friction, sum.push);
        if (traces) trace(a, c, p, touches, x_before, x.xyz, body.position);
    }
    store_point(a.position, p, x);
}

// What the frame found, to go back to.
void run_keep(KeepArgs a, uint p)
{
    a.good_position.at[p] = vec4(load_point(a.position, p).xyz, a.start.at[p].w);
    a.good_velocity.at[p] = a.velocity.at[p];
    a.good_carry.at[p] = a.carry.at[p];
}

void run_check(KeepArgs a, uint p)
{
    if (!is_finite(load_point(a.position, p)) || !is_finite(a.velocity.at[p]) || !is_finite(a.carry.at[p]))
        atomicOr(a.report.at[0], WEFT_REPORT_NON_FINITE);
}

void run_roll_back(KeepArgs a, uint i)
{
    if ((a.report.at[0] & WEFT_REPORT_NON_FINITE) == 0u) return;
    // What was solved was not of this place; a residual and a saved state still read it.
    if (i < a.lambdas) a.lambda.at[i] = 0.0;
    if (i >= a.count) return;
    vec4 good = a.good_position.at[i];
    a.start.at[i] = good;
    store_point(a.position, i, vec4(good.xyz, a.weights.at[i]));
    a.velocity.at[i] = a.good_velocity.at[i];
    a.carry.at[i] = a.good_carry.at[i];
}

#endif
