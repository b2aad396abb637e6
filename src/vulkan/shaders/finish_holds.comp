#version 450
// Holds the faces that still pass a collider. A particle that is held lets the faces around it pass, whose particles are
// held in turn, and so on. One workgroup per cloth, because few are left.
#extension GL_GOOGLE_include_directive : require
#include "vulkan/shaders/workgroup_barrier.glsl"
#include "vulkan/shaders/common.glsl"
#include "vulkan/shaders/dispatch.glsl"
#include "vulkan/shaders/particles.glsl"
#include "vulkan/shaders/face_contact.glsl"

#define WEFT_NO_PARTICLE 0xffffffffu
// Faces of a particle that are tried side by side.
#define WEFT_FACES_AT_ONCE 8u

// One of the faces around a particle of a list. Those that pass go to the other list.
void try_faces_around(uint list, uint item)
{
    uint p = face_contact_args.at.sums.at[first_held(list) + item / WEFT_FACES_AT_ONCE];
    if (p == WEFT_NO_PARTICLE) return;
    uint end = face_contact_args.at.offsets.at[p + 1u];
    for (uint k = face_contact_args.at.offsets.at[p] + item % WEFT_FACES_AT_ONCE; k < end; k += WEFT_FACES_AT_ONCE) {
        uint f = face_of_triangle(face_contact_args.at.items.at[k]);
        if (f != 0xffffffffu) hold_face(f, corners_of_face(f), false, 1u - list);
    }
}

// Leaves in the list the particles that have changed their places.
void settle_list(uint list, uint item)
{
    uint at = first_held(list) + item;
    if (!settle_face_particle(face_contact_args.at.sums.at[at])) face_contact_args.at.sums.at[at] = WEFT_NO_PARTICLE;
}

void main()
{
    if (!find_command()) return;
    uint me = gl_LocalInvocationID.x, all = gl_WorkGroupSize.x, list = 0u;
    uint count = face_contact_args.at.sums.at[length_of_held(list)];
    for (uint round = 0u; round < WEFT_MOST_HOLD_ROUNDS && count > 0u; ++round) {
        for (uint i = me; i < count * WEFT_FACES_AT_ONCE; i += all) try_faces_around(list, i);
        workgroup_barrier();
        if (me == 0u) face_contact_args.at.sums.at[length_of_held(list)] = 0u;
        list = 1u - list;
        count = face_contact_args.at.sums.at[length_of_held(list)];
        for (uint i = me; i < count; i += all) settle_list(list, i);
        workgroup_barrier();
    }
    if (me > 0u) return;
    bool last = face_substep() + 1u == face_contact_args.at.frame.at.substeps;
    if (face_contact_args.at.sums.at[fast_word()] != 0u) face_contact_args.at.sums.at[met_fast_word()] = 1u;
    if (last) face_contact_args.at.sums.at[longest_edge_word()] = face_contact_args.at.sums.at[met_fast_word()] = 0u;
    face_contact_args.at.sums.at[fast_word()] = 0u;
    for (uint which = 0u; which < 2u; ++which) face_contact_args.at.sums.at[length_of_held(which)] = 0u;
}
