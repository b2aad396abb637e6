#version 450
// Marks contacts, and adds up their momentum on each collider in integers.
#extension GL_GOOGLE_include_directive : require
#include "vulkan/shaders/contact_forces/account.glsl"

shared uint sums[WEFT_SUM_WORDS];   // of the workgroup

// The number as 64 bits, low word first. It must be less than 2^63. The two words represent the float exactly.
uvec2 words_of(float quanta)
{
    float size = abs(quanta);
    float high = floor(size * (1.0 / 4294967296.0));
    uvec2 words = uvec2(uint(size - high * 4294967296.0), uint(high));
    if (quanta < 0.0) {
        words = ~words;
        words.x += 1u;
        if (words.x == 0u) words.y += 1u;
    }
    return words;
}

// Each overflow of the low word adds one to the high word, so the sum does not depend on the order.
void add_here(uint at, float quanta)
{
    uvec2 words = words_of(quanta);
    uint before = atomicAdd(sums[at], words.x);
    atomicAdd(sums[at + 1u], words.y + (before + words.x < before ? 1u : 0u));
}

void main()
{
    uint group = workgroup(), me = gl_LocalInvocationID.x;
    if (group >= args.count) return;
    if (me < WEFT_SUM_WORDS) sums[me] = 0u;
    barrier();

    PacketIn packet = args.packets.at[group];
    uint p = packet.first + me, flag = 0u;
    // A frame with non-finite numbers is rolled back, so its contacts do not count.
    if (p < WEFT_ACCOUNT.particles && (WEFT_ACCOUNT.report.at[0] & WEFT_REPORT_NON_FINITE) == 0u) {
        uint at = packet.collider * WEFT_ACCOUNT.capacity + p;
        vec3 moved = WEFT_ACCOUNT.moved.at[at].xyz;
        if (moved != vec3(0.0)) {
            float momentum = contact_momentum(WEFT_ACCOUNT.position.at[p].w, WEFT_ACCOUNT.frame.at.inv_h);
            vec3 linear = quanta_of(moved, momentum);
            if (linear != vec3(0.0)) {
                vec3 angular = quanta_of(WEFT_ACCOUNT.turned.at[at].xyz, momentum);
                for (uint axis = 0u; axis < 3u; ++axis) {
                    add_here(2u * axis, linear[axis]);
                    add_here(2u * axis + 6u, angular[axis]);
                }
                atomicAdd(sums[WEFT_SUM_CONTACTS], 1u);
                flag = 1u;
            }
        }
    }
    args.flags.at[group * WEFT_GROUP + me] = flag;
    barrier();

    if (sums[WEFT_SUM_CONTACTS] == 0u) return;
    uint to = packet.collider * WEFT_SUM_WORDS;
    if (me < 6u) {
        uint low = sums[2u * me];
        uint before = atomicAdd(WEFT_ACCOUNT.sums.at[to + 2u * me], low);
        atomicAdd(WEFT_ACCOUNT.sums.at[to + 2u * me + 1u], sums[2u * me + 1u] + (before + low < before ? 1u : 0u));
    }
    if (me == 6u) atomicAdd(WEFT_ACCOUNT.sums.at[to + WEFT_SUM_CONTACTS], sums[WEFT_SUM_CONTACTS]);
}
