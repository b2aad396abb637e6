#version 450
// Writes each contact to its place in the list, if the list has room for it.
#extension GL_GOOGLE_include_directive : require
#include "vulkan/shaders/contact_forces/account.glsl"

void main()
{
    uint group = workgroup(), i = invocation();
    if (group >= args.count) return;
    uint number = args.flags.at[i], before = i > 0u ? args.flags.at[i - 1u] : 0u;
    if (number == before || number > args.room) return;

    PacketIn packet = args.packets.at[group];
    uint p = packet.first + gl_LocalInvocationID.x;
    vec4 x = WEFT_ACCOUNT.position.at[p];
    vec3 moved = WEFT_ACCOUNT.moved.at[packet.collider * WEFT_ACCOUNT.capacity + p].xyz;
    vec3 quanta = quanta_of(moved, contact_momentum(x.w, WEFT_ACCOUNT.frame.at.inv_h));
    uint to = before * WEFT_RECORD_WORDS;
    for (uint axis = 0u; axis < 3u; ++axis) {
        args.contacts.at[to + axis] = floatBitsToUint(x[axis]);
        args.contacts.at[to + 4u + axis] = floatBitsToUint(from_impulse_quanta(quanta[axis]));
    }
    args.contacts.at[to + 3u] = p;
    args.contacts.at[to + 7u] = packet.collider;
}
