// Dynamic lists: rows that are found anew while the world moves, each with the other rows of the particle that it moves.
#ifndef WEFT_LIST_GLSL
#define WEFT_LIST_GLSL

#include "vulkan/shaders/common.glsl"
#include "vulkan/lists/args.data.h"

layout(push_constant) uniform Push { ListArgs list; };

// The cloth that an item belongs to: the last one that begins there or before.
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

// Rows [first_row(item), first_row(item + 1)) are those of an item. Rows that there is no room for have no place.
uint first_row(uint item) { return min(list.places.at[item], list.capacity); }

#endif
