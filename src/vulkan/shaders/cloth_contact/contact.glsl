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

// See carried_cap() of solver/plan/cloth_contact_numbers.h.
float carried_cap(float cap) { return cap + min(contact.frame.at.surface_motion, WEFT_MOST_CARRIED * cap); }
// How far pushes may move the particles of a tile, and how far a list that is made now allows them to leave their
// trajectory, m.
float own_cap_of_tile(uint tile) { return contact.tiles.at[tile].slack * contact.cap_part; }
float cap_of_tile(uint tile) { return carried_cap(own_cap_of_tile(tile)); }
float slack_now(uint tile)
{
    return contact.tiles.at[tile].slack * (1.0 - contact.cap_part) + cap_of_tile(tile);
}
float slack_when_listed(uint tile)
{
    vec4 mean = contact.tracked.at[tile].mean;
    return mean.w;
}

// How far pushes may move the particle if no surface moves, m.
float own_cap_of(uint p)
{
    vec4 rest = contact.rest.at[p];
    return rest.w;
}
bool of_surface(uint p) { return own_cap_of(p) >= WEFT_CAP_OF_SURFACE; }

// See carry.cpp of the CPU backend.
bool is_carried(uint p) { return contact.carrier.at[p] > 0u && !of_surface(p); }
vec3 carried_place(uint p, uint carrier)
{
    PoseRef poses = PoseRef(contact.carriers.at[carrier - 1u]);
    PoseIn before = poses.at[head.substep], now = poses.at[head.substep + 1u];
    vec3 local = unrotate(before.x.xyz, before.y.xyz, before.z.xyz, contact.start.at[p].xyz - before.position.xyz);
    return rotate(now.x.xyz, now.y.xyz, now.z.xyz, local) + now.position.xyz;
}
vec3 base_of(uint p)
{
    if (is_carried(p)) return carried_place(p, contact.carrier.at[p]);
    return contact.start.at[p].xyz;
}

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
