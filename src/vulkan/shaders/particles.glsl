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

vec3 gravity_of(FrameRef frame) { return vec3(frame.at.gravity_x, frame.at.gravity_y, frame.at.gravity_z); }

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
    bool capped = predict(x.xyz, m, x.w, gravity_of(particle_args.at.frame), particle_args.at.frame.at.max_speed,
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
    bool capped = update_velocity(m, x.xyz, start, x.w, particle_args.at.frame.at.max_speed,
                                  substep_of(particle_args.at.frame));
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
    bool ended = update_velocity(m, x.xyz, start, x.w, particle_args.at.frame.at.max_speed, h);
    start = x.xyz;
    bool begun = predict(x.xyz, m, x.w, gravity_of(particle_args.at.frame), particle_args.at.frame.at.max_speed, h);
    store_point(particle_args.at.position, p, x);
    particle_args.at.start.at[p] = vec4(start, m.v_dropped.x);
    store_motion(p, m);
    report_capped(ended || begun);
}

void run_targets(uint i)
{
    TargetIn target = target_args.at.targets.at[i];
    uint after = target_args.at.substep + substeps_before + 1u;
    PoseIn pose = target_args.at.poses.at[after * target_args.at.frame.at.motions + target.motion];
    vec3 x = rotate(pose.x.xyz, pose.y.xyz, pose.z.xyz, target.local.xyz) + pose.position.xyz;
    store_point(target_args.at.position, target.particle, vec4(x, load_point(target_args.at.position, target.particle).w));
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
    store_point(average_args.at.position, p, vec4(x.xyz + sum, x.w));
}

// Adds the effect of a contact to the particle's sums of the frame. The first contact pass of a frame resets the sums.
void trace(uint collider, uint p, bool touches, vec3 before, vec3 x, vec3 position)
{
    bool begins = contact_args.at.substep + substeps_before == 0u && contact_args.at.first_iteration == 1u;
    if (!touches && !begins) return;
    uint at = collider * contact_args.at.capacity + p;
    uint turned = contact_args.at.frame.at.colliders * contact_args.at.capacity + at;
    ContactTrace sum = ContactTrace(vec3(0.0), vec3(0.0));
    if (!begins) sum = ContactTrace(contact_args.at.contact_log.at[at].xyz, contact_args.at.contact_log.at[turned].xyz);
    if (touches) trace_contact(sum, before, x, position);
    contact_args.at.contact_log.at[at] = vec4(sum.moved, 0.0);
    contact_args.at.contact_log.at[turned] = vec4(sum.turned, 0.0);
}

void run_contact(uint p)
{
    vec4 x = load_point(contact_args.at.position, p);
    vec3 start = contact_args.at.start.at[p].xyz;
    uint colliders = contact_args.at.frame.at.colliders, substep = contact_args.at.substep + substeps_before;
    bool keeps = !is_none(uvec2(contact_args.at.sums)), traces = !is_none(uvec2(contact_args.at.contact_log));
    for (uint c = 0u; c < colliders; ++c) {
        ColliderIn collider = contact_args.at.colliders.at[c];
        PoseIn now = contact_args.at.poses.at[(substep + 1u) * colliders + c];
        PoseIn before = contact_args.at.poses.at[substep * colliders + c];
        ContactBody body = ContactBody(now.x.xyz, now.y.xyz, now.z.xyz, now.position.xyz, before.x.xyz, before.y.xyz,
                                       before.z.xyz, before.position.xyz, collider.static_friction,
                                       collider.kinetic_friction, contact_args.at.frame.at.half_thickness,
                                       contact_args.at.frame.at.depenetration);
        ShapeNumbers shape = ShapeNumbers(collider.numbers.x, collider.numbers.y, collider.numbers.z, collider.numbers.w,
                                          ShapeBlocks(collider.data));
        uint at = c * contact_args.at.capacity + p;
        ContactSum sum = ContactSum(vec3(0.0), 0.0);
        if (keeps && contact_args.at.first_iteration == 0u) {
            vec4 kept = contact_args.at.sums.at[at];
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
        if (keeps) contact_args.at.sums.at[at] = vec4(sum.friction, sum.push);
        if (traces) trace(c, p, touches, x_before, x.xyz, body.position);
    }
    store_point(contact_args.at.position, p, x);
}

// Saves the state at the beginning of the frame, for run_roll_back().
void run_keep(uint p)
{
    keep_args.at.good_position.at[p] = vec4(load_point(keep_args.at.position, p).xyz, keep_args.at.start.at[p].w);
    keep_args.at.good_velocity.at[p] = keep_args.at.velocity.at[p];
    keep_args.at.good_compensation.at[p] = keep_args.at.compensation.at[p];
}

void run_check(uint p)
{
    if (!is_finite(load_point(keep_args.at.position, p)) || !is_finite(keep_args.at.velocity.at[p]) ||
        !is_finite(keep_args.at.compensation.at[p]))
        atomicOr(keep_args.at.island_report.at[0], WEFT_REPORT_NON_FINITE);
}

void run_roll_back(uint i)
{
    if ((keep_args.at.island_report.at[0] & (WEFT_REPORT_NON_FINITE | WEFT_REPORT_LIST_FULL)) == 0u) return;
    // Lambda does not match the restored positions. Residuals and saved states still read it.
    if (i < keep_args.at.lambdas) keep_args.at.lambda.at[i] = 0.0;
    if (i >= keep_args.at.count) return;
    vec4 good = keep_args.at.good_position.at[i];
    keep_args.at.start.at[i] = good;
    store_point(keep_args.at.position, i, vec4(good.xyz, keep_args.at.weights.at[i]));
    keep_args.at.velocity.at[i] = keep_args.at.good_velocity.at[i];
    keep_args.at.compensation.at[i] = keep_args.at.good_compensation.at[i];
}

#endif
