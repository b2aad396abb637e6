// Contact of particles with the colliders near their tile.
#ifndef WEFT_CONTACT_GLSL
#define WEFT_CONTACT_GLSL

#include "vulkan/shaders/collider_lists.glsl"

uint contact_substep() { return contact_args.at.substep + substeps_before; }

bool begins_frame() { return contact_substep() == 0u && contact_args.at.first_iteration == 1u; }

// Adds the effect of a contact to the particle's sums of the frame. The first contact pass of a frame resets the sums.
void trace(uint at, bool touches, vec3 before, vec3 x, vec3 position)
{
    bool begins = begins_frame();
    if (!touches && !begins) return;
    uint turned = contact_args.at.capacity * WEFT_COLLIDER_TILE + at;
    ContactTrace sum = ContactTrace(vec3(0.0), vec3(0.0));
    if (!begins) sum = ContactTrace(contact_args.at.contact_log.at[at].xyz, contact_args.at.contact_log.at[turned].xyz);
    if (touches) trace_contact(sum, before, x, position);
    contact_args.at.contact_log.at[at] = vec4(sum.moved, 0.0);
    contact_args.at.contact_log.at[turned] = vec4(sum.turned, 0.0);
}

// Contact of one particle with the collider of one slot.
void meet_collider(uint slot, uint p, inout vec4 x, vec3 start)
{
    ColliderIn collider = contact_args.at.colliders.at.colliders.at[contact_args.at.slots.at[slot]];
    ContactBody body = body_of(contact_args.at.colliders, collider, contact_args.at.frame, contact_substep());
    bool keeps = !is_none(uvec2(contact_args.at.sums)), traces = !is_none(uvec2(contact_args.at.contact_log));
    uint at = place_in_slot(slot, p);
    ContactSum sum = ContactSum(vec3(0.0), 0.0);
    if (keeps && contact_args.at.first_iteration == 0u) {
        vec4 kept = contact_args.at.sums.at[at];
        sum = ContactSum(kept.xyz, kept.w);
    }
    vec3 local = to_body(body, x.xyz);
    vec3 normal, normal_at_start;
    float gap = distance_to(collider, local, normal) - body.half_thickness;
    vec3 x_before = x.xyz;
    bool touches = gap < 0.0 || sum.push > 0.0;
    if (touches) {
        float gap_at_start =
            distance_to(collider, to_body_at_start(body, start), normal_at_start) - body.half_thickness;
        project_contact(x.xyz, start, x.w, sum, gap, gap_at_start, rotate(body.rx, body.ry, body.rz, normal),
                        carried_by(body, local), body);
    }
    if (keeps) contact_args.at.sums.at[at] = vec4(sum.friction, sum.push);
    if (traces) trace(at, touches, x_before, x.xyz, body.position);
}

void run_contact(uint p)
{
    vec4 x = load_point(contact_args.at.position, p);
    vec3 start = contact_args.at.start.at[p].xyz;
    uvec2 slots = slots_near(contact_args.at.tiles, p);
    for (uint slot = slots.x; slot < slots.y; ++slot) meet_collider(slot, p, x, start);
    store_point(contact_args.at.position, p, x);
}

#endif
