// Common start of the shaders of contact between cloths. The passes and their order are in
// vulkan/cloth_contact/cloth_contact.cpp, the law in physics/cloth_contact/cloth_contact.md.
#ifndef WEFT_CLOTH_CONTACT_GLSL
#define WEFT_CLOTH_CONTACT_GLSL

#include "vulkan/shaders/common.glsl"
#include "vulkan/cloth_contact/args.data.h"

layout(push_constant) uniform Push { ClothContactArgs args; };

#define contact args.data.at
#define head args.data.at.head.at

uint group_index() { return gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x; }

uint near_count() { return min(args.search == 0u ? head.near0 : head.near1, contact.near_capacity); }
uint near_index(uint i) { return args.search * contact.near_capacity + i; }
uint listed_count(uint list) { return min(list == 0u ? head.listed0 : head.listed1, contact.listed_capacity); }
uint listed_index(uint list, uint i) { return list * contact.listed_capacity + i; }

// Whether a search has nothing to do. Round 1 of the search for the motion follows the brake.
bool is_idle_search()
{
    if (args.search == WEFT_SEARCH_ANYWHERE) return head.uncovered == 0u;
    return args.round == 1u && head.brakes == 0u;
}

vec3 sum_of(Uints sums, uint p, float quanta)
{
    return vec3(int(sums.at[4u * p]), int(sums.at[4u * p + 1u]), int(sums.at[4u * p + 2u])) * (1.0 / quanta);
}
void add_to(Uints sums, uint p, vec3 change, float quanta)
{
    atomicAdd(sums.at[4u * p], uint(int(to_contact_quanta(change.x, quanta))));
    atomicAdd(sums.at[4u * p + 1u], uint(int(to_contact_quanta(change.y, quanta))));
    atomicAdd(sums.at[4u * p + 2u], uint(int(to_contact_quanta(change.z, quanta))));
}
void clear_sum(Uints sums, uint p)
{
    for (uint axis = 0u; axis < 3u; ++axis) sums.at[4u * p + axis] = 0u;
}
float share_of(uint p) { return float(contact.share.at[p]) * float(1.0 / WEFT_WEIGHT_QUANTA); }

#endif
