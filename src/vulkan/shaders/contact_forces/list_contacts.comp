#version 450
// Writes each contact to its place in the list, if the list has room for it.
#extension GL_GOOGLE_include_directive : require
#include "vulkan/shaders/contact_forces/account.glsl"

void main()
{
    ContactPlace contact;
    if (!find_contact(contact)) return;
    uint i = invocation(), number = args.flags.at[i], before = i > 0u ? args.flags.at[i - 1u] : 0u;
    if (number == before || number > args.room) return;

    vec4 x = WEFT_ACCOUNT.position.at[contact.particle];
    vec3 moved = WEFT_ACCOUNT.moved.at[contact.at].xyz;
    vec3 quanta = quanta_of(moved, contact_momentum(x.w, WEFT_ACCOUNT.frame.at.inv_h));
    uint to = before * WEFT_RECORD_WORDS;
    for (uint axis = 0u; axis < 3u; ++axis) {
        args.contacts.at[to + axis] = floatBitsToUint(x[axis]);
        args.contacts.at[to + 4u + axis] = floatBitsToUint(from_impulse_quanta(quanta[axis]));
    }
    args.contacts.at[to + 3u] = contact.particle;
    args.contacts.at[to + 7u] = contact.collider;
}
