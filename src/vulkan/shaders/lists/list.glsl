// Dynamic lists: constraints that are found anew in every frame. The constraints of a particle are consecutive.
#ifndef WEFT_LIST_GLSL
#define WEFT_LIST_GLSL

#include "vulkan/shaders/common.glsl"
#include "vulkan/lists/args.data.h"
#include "vulkan/shaders/collider_lists.glsl"

layout(push_constant) uniform Push { ListArgs list; };

// The cloth that an item belongs to: the last one that begins at or before the item.
uint member_of(uint item)
{
    uint begin = 0u, end = list.member_count;
    while (begin + 1u < end) {
        uint middle = (begin + end) / 2u;
        if (list.members.at[middle].first <= item) begin = middle;
        else end = middle;
    }
    return begin;
}

uint particle_of(uint member, uint item) { return list.members.at[member].base + item - list.members.at[member].first; }

// An item has rows [first_row(item), first_row(item + 1)). Rows beyond the capacity are left out.
uint first_row(uint item) { return min(list.places.at[item], list.capacity); }

#endif
