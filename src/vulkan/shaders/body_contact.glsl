// Contact of particles with the bodies near their tile (body.md).
#ifndef WEFT_BODY_CONTACT_GLSL
#define WEFT_BODY_CONTACT_GLSL

#include "vulkan/shaders/contact.glsl"
#include "vulkan/shaders/sums_of_bodies.glsl"

// A particle and its distance to a body.
struct NearBody {
    ColliderIn collider;
    ContactBody body;
    Solid solid;
    vec3 local, local_at_start, normal;
    float gap, way;
};
NearBody near_body(uint slot, uint p, vec3 x, vec3 start)
{
    NearBody near;
    near.collider = contact_args.at.colliders.at.colliders.at[contact_args.at.slots.at[slot]];
    near.body = body_of(contact_args.at.colliders, near.collider, contact_args.at.frame, contact_substep(),
                        half_thickness_at(contact_args.at.frame, p));
    near.solid = solid_of(near.collider);
    near.local = to_body(near.body, x);
    near.local_at_start = to_body_at_start(near.body, start);
    near.gap = solid_distance(near.solid, near.local, near.normal) - near.body.half_thickness;
    vec3 step = near.local - near.local_at_start;
    near.way = sqrt(dot(step, step));
    return near;
}

// What lies behind the particle in the substep.
Support find_support(uint p, vec3 x, uvec2 slots)
{
    Support support = no_support();
    FrameRef frame = contact_args.at.frame;
    float half_thickness = half_thickness_at(frame, p);
    // At the start of the substep: prediction has added what gravity gives.
    vec3 velocity = contact_args.at.velocity.at[p].xyz - gravity_of(frame) * frame.at.h;
    for (uint slot = slots.x; slot < slots.y; ++slot) {
        if (holds_body(slot)) continue;
        uint number = contact_args.at.slots.at[slot];
        ColliderIn collider = contact_args.at.colliders.at.colliders.at[number];
        ContactBody body = body_of(contact_args.at.colliders, collider, frame, contact_substep(), half_thickness);
        vec3 local = to_body(body, x), normal;
        float gap = solid_distance(solid_of(collider), local, normal) - body.half_thickness;
        vec3 world_normal = rotate(body.rx, body.ry, body.rz, normal), carried = carried_by(body, local);
        vec3 slides = velocity - carried * contact_args.at.frame.at.inv_h;
        support_by(support, x, gap, world_normal, body.half_thickness,
                   friction_on_support(slides, world_normal, body.static_friction, body.kinetic_friction),
                   float(number), carried);
    }
    store_support(p, support);
    return support;
}

// m, at most 0: how far the support will push the particle toward the body.
float inside_support(Support support, NearBody near, vec3 x, vec3 start)
{
    vec3 normal = rotate(near.body.rx, near.body.ry, near.body.rz, near.normal);
    return min(room_before(support, x, start, normal, near.body.depenetration), 0.0);
}

// How many particles touch each body.
void run_count_touches(uint p)
{
    vec4 x = load_point(contact_args.at.position, p);
    vec3 start = contact_args.at.start.at[p].xyz;
    uvec2 slots = slots_near(contact_args.at.tiles, p);
    ContactSum none = ContactSum(vec3(0.0), 0.0);
    Support support = no_support();
    if (supports_in(slots)) support = find_support(p, x.xyz, slots);
    // Lists made later in the substep may have a body for a particle that has none now.
    else store_support(p, support);
    for (uint slot = slots.x; slot < slots.y; ++slot) {
        if (!holds_body(slot)) continue;
        NearBody near = near_body(slot, p, x.xyz, start);
        float inside = inside_support(support, near, x.xyz, start);
        if (!may_touch(near.gap + inside, none, near.way, near.solid, near.body)) continue;
        ContactPlane plane =
            contact_plane(near.solid, near.body, none, near.local, near.local_at_start, near.gap, near.normal);
        if (plane.gap + inside < 0.0 && x.w > 0.0) add_touch(contact_args.at.colliders.at.bodies, near.collider.body);
    }
    mark_faces(p, false, false);
}

// Contact with the body of one slot. Returns whether faces of the particle may touch.
bool touch_body_of(uint slot, uint p, inout vec4 x, vec3 start, inout Support support)
{
    NearBody near = near_body(slot, p, x.xyz, start);
    uint at = place_in_slot(slot, p), body = near.collider.body;
    ContactSum sum = ContactSum(vec3(0.0), 0.0);
    if (contact_args.at.first_iteration == 0u) {
        vec4 kept = contact_args.at.sums.at[at];
        sum = ContactSum(kept.xyz, kept.w);
    }
    vec4 before = x;
    vec3 undone = vec3(0.0);
    float inside = inside_support(support, near, x.xyz, start);
    bool touches = may_touch(near.gap + inside, sum, near.way, near.solid, near.body);
    if (touches) {
        contact_moved_body(near.solid, near.body, moved_body(contact_args.at.colliders.at.bodies, body),
                           float(contact_args.at.slots.at[slot]), x.xyz, start, x.w, sum, near.local,
                           near.local_at_start, near.gap, near.normal, support, undone);
        vec3 by = (x.xyz - before.xyz) + undone;
        if (dot(by, by) > 0.0 && feels_cloth(contact_args.at.colliders.at.bodies, body))
            add_to_body(contact_args.at.colliders.at.bodies, body, by, before.xyz, x.w);
        if (sum.push > 0.0) add_touch(contact_args.at.colliders.at.bodies, body);
    }
    if (!is_none(uvec2(contact_args.at.contact_log))) trace(at, touches, before.xyz - undone, x, near.body.position, p);
    contact_args.at.sums.at[at] = vec4(sum.friction, sum.push);
    return marks_faces(near.solid, near.body, near.gap, near.way, x.xyz - before.xyz);
}

void run_touch_bodies(uint p)
{
    vec4 x = load_point(contact_args.at.position, p);
    vec3 start = contact_args.at.start.at[p].xyz;
    uvec2 slots = slots_near(contact_args.at.tiles, p);
    bool near = false, presses = supports_in(slots);
    Support support = no_support();
    if (presses) support = load_support(p);
    for (uint slot = slots.x; slot < slots.y; ++slot) {
        if (!holds_body(slot)) continue;
        bool marks = touch_body_of(slot, p, x, start, support);
        near = near || marks;
    }
    if (presses) store_pressed(p, support);
    store_point(contact_args.at.position, p, x);
    // The count has begun the marks of the first sweep.
    mark_faces(p, near, contact_args.at.first_iteration == 1u);
}

#endif
