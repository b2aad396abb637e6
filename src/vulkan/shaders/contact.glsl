// Contact of particles with the colliders near their tile.
#ifndef WEFT_CONTACT_GLSL
#define WEFT_CONTACT_GLSL

#include "vulkan/shaders/collider_lists.glsl"

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

// Whether faces of a particle may touch the collider, or contact has moved it.
bool marks_faces(Solid solid, ContactBody body, float gap, float way, vec3 moved)
{
    if (dot(moved, moved) > 0.0) return true;
    float nearest = contact_args.at.frame.at.nearest_of_faces;
    return reaches_faces(solid.roundness, body.half_thickness, nearest, contact_args.at.frame.at.circle_of_faces) &&
           faces_may_touch(solid, gap + body.half_thickness, way, nearest, contact_args.at.frame.at.widest_face);
}

// Contact of one particle with the collider of one slot. Returns whether faces of the particle may touch.
bool meet_collider(uint slot, uint p, inout vec4 x, vec3 start)
{
    ColliderIn collider = contact_args.at.colliders.at.colliders.at[contact_args.at.slots.at[slot]];
    if (is_body(collider)) return false;  // touch_bodies
    ContactBody body = body_of(contact_args.at.colliders, collider, contact_args.at.frame, contact_substep());
    bool keeps = !is_none(uvec2(contact_args.at.sums)), traces = !is_none(uvec2(contact_args.at.contact_log));
    uint at = place_in_slot(slot, p);
    ContactSum sum = ContactSum(vec3(0.0), 0.0);
    if (keeps && contact_args.at.first_iteration == 0u) {
        vec4 kept = contact_args.at.sums.at[at];
        sum = ContactSum(kept.xyz, kept.w);
    }
    Solid solid = solid_of(collider);
    vec3 local = to_body(body, x.xyz), local_at_start = to_body_at_start(body, start), step = local - local_at_start;
    float way = sqrt(dot(step, step));
    vec3 normal;
    float gap = solid_distance(solid, local, normal) - body.half_thickness;
    vec3 x_before = x.xyz;
    bool touches = may_touch(gap, sum, way, solid, body);
    if (touches) contact_particle(solid, body, x.xyz, start, x.w, sum, local, local_at_start, gap, normal);
    if (keeps) contact_args.at.sums.at[at] = vec4(sum.friction, sum.push);
    if (traces) trace(at, touches, x_before, x, body.position, p);
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
    bool near = false;
    for (uint slot = slots.x; slot < slots.y; ++slot) {
        bool may_touch = meet_collider(slot, p, x, start);
        near = near || may_touch;
    }
    store_point(contact_args.at.position, p, x);
    mark_faces(p, near, (contact_args.at.parts & WEFT_CONTACT_KEEPS_MARKS) != 0u);
}

#endif
