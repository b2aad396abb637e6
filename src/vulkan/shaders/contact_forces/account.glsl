// Data of the contact that an invocation works on. Slots are sorted by cloth, collider and tile, so that contacts are in
// the order of the list.
#ifndef WEFT_ACCOUNT_GLSL
#define WEFT_ACCOUNT_GLSL

#include "vulkan/shaders/primitives/tiles.glsl"
#include "vulkan/contact_forces/args.data.h"

#include "physics/lanes.glsl"

#include "physics/contact/contact_forces.kernel.h"

layout(push_constant) uniform Push { ContactListArgs args; };

#define WEFT_REPORT_NON_FINITE 2u
#define WEFT_NO_SLOT 0xffffffffu

// Contact data of the cloth, read in place (vulkan/shaders/commands.glsl).
#define WEFT_ACCOUNT args.accounts.at[contact.cloth]

struct ContactPlace {
    uint cloth;
    uint collider;
    uint particle;
    uint at;  // in AccountIn::moved
};

// The particle and the collider of this invocation. Returns false if it has no collider. A tile at the end of a cloth may
// have fewer particles.
bool find_contact(out ContactPlace contact)
{
    uint place = invocation() / WEFT_COLLIDER_TILE, in_tile = invocation() % WEFT_COLLIDER_TILE;
    if (place >= args.slot_count) return false;
    uint slot = args.slots.at[place];
    if (slot == WEFT_NO_SLOT) return false;
    uint begin = 0u, end = args.cloths;  // the last cloth whose slots begin at or before this one
    while (begin + 1u < end) {
        uint middle = (begin + end) / 2u;
        if (args.accounts.at[middle].first_slot <= slot) begin = middle;
        else end = middle;
    }
    contact = ContactPlace(begin, args.pairs.at[place] - args.accounts.at[begin].first_pair,
                           args.tiles.at[place] * WEFT_COLLIDER_TILE + in_tile,
                           (slot - args.accounts.at[begin].first_slot) * WEFT_COLLIDER_TILE + in_tile);
    return true;
}

vec3 quanta_of(vec3 v, float momentum)
{
    return vec3(to_impulse_quanta(v.x * momentum), to_impulse_quanta(v.y * momentum), to_impulse_quanta(v.z * momentum));
}

#endif
