#version 450
// Marks contacts, and adds up their momentum on each collider in integers.
#extension GL_GOOGLE_include_directive : require
#include "vulkan/shaders/contact_forces/account.glsl"
#include "vulkan/shaders/sum_words.glsl"

// Of each slot that the workgroup works on.
shared uint sums[WEFT_GROUP / WEFT_COLLIDER_TILE * WEFT_SUM_WORDS];

// Each overflow of the low word adds one to the high word, so the sum does not depend on the order.
void add_here(uint at, float quanta)
{
    uvec2 words = words_of(quanta);
    uint before = atomicAdd(sums[at], words.x);
    atomicAdd(sums[at + 1u], words.y + (before + words.x < before ? 1u : 0u));
}

void main()
{
    uint me = gl_LocalInvocationID.x, flag = 0u;
    if (me < sums.length()) sums[me] = 0u;
    barrier();

    ContactPlace contact;
    bool found = find_contact(contact), counts = found && contact.particle < WEFT_ACCOUNT.particles;
    uint here = me / WEFT_COLLIDER_TILE * WEFT_SUM_WORDS;
    // A frame with non-finite numbers is rolled back, so its contacts do not count.
    if (counts && (WEFT_ACCOUNT.report.at[WEFT_REPORT_BITS] & WEFT_REPORT_NON_FINITE) == 0u) {
        vec3 moved = WEFT_ACCOUNT.moved.at[contact.at].xyz;
        if (moved != vec3(0.0)) {
            float momentum = contact_momentum(WEFT_ACCOUNT.position.at[contact.particle].w, WEFT_ACCOUNT.frame.at.inv_h);
            vec3 linear = quanta_of(moved, momentum);
            if (linear != vec3(0.0)) {
                vec3 angular = quanta_of(WEFT_ACCOUNT.turned.at[contact.at].xyz, momentum);
                for (uint axis = 0u; axis < 3u; ++axis) {
                    add_here(here + 2u * axis, linear[axis]);
                    add_here(here + 2u * axis + 6u, angular[axis]);
                }
                atomicAdd(sums[here + WEFT_SUM_CONTACTS], 1u);
                flag = 1u;
            }
        }
    }
    if (invocation() < args.slot_count * WEFT_COLLIDER_TILE) args.flags.at[invocation()] = flag;
    barrier();

    if (!found || sums[here + WEFT_SUM_CONTACTS] == 0u) return;
    uint word = me % WEFT_COLLIDER_TILE, to = contact.collider * WEFT_SUM_WORDS;
    if (word < 6u) {
        uint low = sums[here + 2u * word];
        uint before = atomicAdd(WEFT_ACCOUNT.sums.at[to + 2u * word], low);
        uint high = sums[here + 2u * word + 1u] + (before + low < before ? 1u : 0u);
        atomicAdd(WEFT_ACCOUNT.sums.at[to + 2u * word + 1u], high);
    }
    if (word == 6u) atomicAdd(WEFT_ACCOUNT.sums.at[to + WEFT_SUM_CONTACTS], sums[here + WEFT_SUM_CONTACTS]);
}
