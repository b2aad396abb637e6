// Contact of particles with the colliders near their tile.
#ifndef WEFT_CONTACT_GLSL
#define WEFT_CONTACT_GLSL

#include "vulkan/shaders/collider_lists.glsl"
#include "vulkan/shaders/thickness.glsl"

uint contact_substep() { return contact_args.at.substep + substeps_before; }

bool has_bodies() { return (contact_args.at.parts & WEFT_CONTACT_BODIES) != 0u; }
// Whether lists begin with this pass.
bool begins_frame() { return contact_substep() == 0u && (contact_args.at.parts & WEFT_CONTACT_BEGINS) != 0u; }
// Whether the contact log of this pass's colliders does.
bool begins_log() { return contact_substep() == 0u && contact_args.at.first_iteration == 1u; }

// How many times its mass the particle weighs in the substep.
float heavier(FrameRef frame, uint p, float w)
{
    return is_none(uvec2(frame.at.weights)) ? 1.0 : mass_ratio(w, frame.at.weights.at[p]);
}

// Adds the effect of a contact to the particle's sums of the frame. The first contact pass of a frame resets the sums.
void trace(uint at, bool touches, vec3 before, vec4 x, vec3 position, uint p)
{
    bool begins = begins_log();
    if (!touches && !begins) return;
    uint turned = contact_args.at.capacity * WEFT_COLLIDER_TILE + at;
    ContactTrace sum = ContactTrace(vec3(0.0), vec3(0.0));
    if (!begins) sum = ContactTrace(contact_args.at.contact_log.at[at].xyz, contact_args.at.contact_log.at[turned].xyz);
    if (touches) trace_contact(sum, before, x.xyz, position, heavier(contact_args.at.frame, p, x.w));
    contact_args.at.contact_log.at[at] = vec4(sum.moved, 0.0);
    contact_args.at.contact_log.at[turned] = vec4(sum.turned, 0.0);
}

// Whether faces may touch a collider of this roundness where their corners do not: faces_touch().
bool cloth_reaches_faces(FrameRef frame, float roundness)
{
    float least = frame.at.least_half_thickness;
    return reaches_faces(roundness, least, nearest_of_faces(least), frame.at.circle_of_faces);
}

// m: the longest edge that has been found in the frame, or 0 if none is longer than usual.
float longest_edge_now()
{
    if (is_none(uvec2(contact_args.at.face_sums))) return 0.0;
    return uintBitsToFloat(
        contact_args.at.face_sums.at[WEFT_FACE_SUM * contact_args.at.particles + WEFT_LONGEST_EDGE_WORD]);
}

// Whether faces of a particle may touch the collider, or contact has moved it.
bool marks_faces(Solid solid, ContactBody body, float gap, float way, vec3 moved)
{
    if (dot(moved, moved) > 0.0) return true;
    FrameRef frame = contact_args.at.frame;
    return cloth_reaches_faces(frame, solid.roundness) &&
           faces_may_touch(solid, gap + body.half_thickness, way, frame.at.nearest_of_faces,
                           max(frame.at.widest_face, longest_edge_now()));
}

// What lies behind a particle that bodies may press on a collider (support.kernel.h).
Support load_support(uint p)
{
    vec4 plane = contact_args.at.supports.at[WEFT_SUPPORT_BLOCKS * p],
         taken = contact_args.at.supports.at[WEFT_SUPPORT_BLOCKS * p + 1u],
         carried = contact_args.at.supports.at[WEFT_SUPPORT_BLOCKS * p + 2u],
         friction = contact_args.at.supports.at[WEFT_SUPPORT_BLOCKS * p + 3u],
         seen = contact_args.at.supports.at[WEFT_SUPPORT_BLOCKS * p + 4u];
    return Support(plane.xyz, plane.w, taken.xyz, taken.w, carried.xyz, carried.w, friction.x, friction.y, seen.xyz,
                   seen.w);
}
void store_taken(uint p, Support support)
{
    contact_args.at.supports.at[WEFT_SUPPORT_BLOCKS * p + 1u] = vec4(support.rubbed, support.pushed);
}
// What bodies change.
void store_pressed(uint p, Support support)
{
    store_taken(p, support);
    contact_args.at.supports.at[WEFT_SUPPORT_BLOCKS * p + 3u] = vec4(support.friction, support.presser, 0.0, 0.0);
    contact_args.at.supports.at[WEFT_SUPPORT_BLOCKS * p + 4u] = vec4(support.seen, support.height);
}
void store_support(uint p, Support support)
{
    contact_args.at.supports.at[WEFT_SUPPORT_BLOCKS * p] = vec4(support.normal, support.offset);
    contact_args.at.supports.at[WEFT_SUPPORT_BLOCKS * p + 2u] = vec4(support.carried, support.collider);
    store_pressed(p, support);
}

// Whether the slot holds a body.
bool holds_body(uint slot)
{
    return is_body(contact_args.at.colliders.at.colliders.at[contact_args.at.slots.at[slot]]);
}

// Whether bodies may press the particle of these slots on another collider.
bool supports_in(uvec2 slots)
{
    if (is_none(uvec2(contact_args.at.supports))) return false;
    bool bodies = false, others = false;
    for (uint slot = slots.x; slot < slots.y; ++slot) {
        bool body = holds_body(slot);
        bodies = bodies || body;
        others = others || !body;
    }
    return bodies && others;
}

// Contact of one particle with the collider of one slot. Returns whether faces of the particle may touch.
bool meet_collider(uint slot, uint p, inout vec4 x, vec3 start, Support support)
{
    ColliderIn collider = contact_args.at.colliders.at.colliders.at[contact_args.at.slots.at[slot]];
    if (is_body(collider)) return false;  // touch_bodies
    ContactBody body = body_of(contact_args.at.colliders, collider, contact_args.at.frame, contact_substep(),
                               half_thickness_at(contact_args.at.frame, p));
    bool keeps = !is_none(uvec2(contact_args.at.sums)), traces = !is_none(uvec2(contact_args.at.contact_log));
    uint at = place_in_slot(slot, p);
    ContactSum sum = ContactSum(vec3(0.0), 0.0);
    if (keeps && contact_args.at.first_iteration == 0u) {
        vec4 kept = contact_args.at.sums.at[at];
        sum = ContactSum(kept.xyz, kept.w);
    }
    vec3 taken = take_support(sum, body, support, float(contact_args.at.slots.at[slot]));
    Solid solid = solid_of(collider);
    vec3 local = to_body(body, x.xyz), local_at_start = to_body_at_start(body, start), step = local - local_at_start;
    float way = sqrt(dot(step, step));
    vec3 normal;
    float gap = solid_distance(solid, local, normal) - body.half_thickness;
    vec3 x_before = x.xyz;
    bool touches = may_touch(gap, sum, way, solid, body);
    if (touches) contact_particle(solid, body, x.xyz, start, x.w, sum, local, local_at_start, gap, normal);
    if (keeps) contact_args.at.sums.at[at] = vec4(sum.friction, sum.push);
    if (traces) trace(at, touches, x_before - taken, x, body.position, p);
    return marks_faces(solid, body, gap, way, x.xyz - x_before);
}

void mark_faces(uint p, bool near, bool keeps)
{
    if (p >= contact_args.at.particles || is_none(uvec2(contact_args.at.face_sums))) return;
    uint at = WEFT_FACE_SUM * p + 5u, mark = near ? WEFT_NEAR_FACES : 0u;
    contact_args.at.face_sums.at[at] = keeps ? contact_args.at.face_sums.at[at] | mark : mark;
}

void run_contact(uint p)
{
    vec4 x = load_point(contact_args.at.position, p);
    vec3 start = contact_args.at.start.at[p].xyz;
    uvec2 slots = slots_near(contact_args.at.tiles, p);
    bool near = false, presses = supports_in(slots);
    Support support = no_support();
    if (presses) support = load_support(p);
    for (uint slot = slots.x; slot < slots.y; ++slot) {
        bool may_touch = meet_collider(slot, p, x, start, support);
        near = near || may_touch;
    }
    store_point(contact_args.at.position, p, x);
    if (presses) {
        // It has been added to the pushes of the colliders.
        support.rubbed = vec3(0.0);
        support.pushed = 0.0;
        store_taken(p, support);
    }
    mark_faces(p, near, (contact_args.at.parts & WEFT_CONTACT_KEEPS_MARKS) != 0u);
}

#endif
