// What the passes of dynamic lists are told, read by C++ and by GLSL.
#ifndef WEFT_VULKAN_LISTS_ARGS_H
#define WEFT_VULKAN_LISTS_ARGS_H

#include "vulkan/args.data.h"

// Words of ListArgs::head: workgroups along three axes, as an indirect dispatch reads them, then the rows that the frame
// wants.
#define WEFT_LIST_WANTED 3
#define WEFT_LIST_HEAD_WORDS 4

#ifdef __cplusplus
namespace weft::vulkan {
using ListMemberRef = std::uint64_t;
#else
layout(buffer_reference) buffer ListMemberRef;
#endif

// A cloth that has rows in a list. Its particles are the list's items from `first` on.
struct ListMemberIn {
    FrameRef frame;
    ColliderRef colliders;
    PoseRef poses;  // [substep · colliders + collider]
    Uints report;
    uint base;  // its first particle in the world
    uint first;
    uint unused0;
    uint unused1;
};

struct ListArgs {
    ListMemberRef members;
    Vec4s position;  // of the world
    Uints places;    // items + 1: how many rows each item has, from the second one on; summed up, where they begin
    Uints particles;  // [row], and so are the next ones
    Floats fields;    // [field · stride + row]
    Floats share;
    Vec4s holds;  // place in the collider's frame, number of the collider
    Vec4s corrections;
    Uints head;
    uint member_count;
    uint items;
    uint capacity;
    uint stride;
    uint substep;
    uint mean;      // 1: an item takes the sum of its rows divided by their number
    uint group;     // rows of a workgroup
    uint widest;    // workgroups along an axis at most
    uint first;     // of gather: items [first, end)
    uint end;
};

#ifdef __cplusplus
}  // namespace weft::vulkan
#else
layout(buffer_reference, std430, buffer_reference_align = 16) readonly buffer ListMemberRef {
    ListMemberIn at[];
};
#endif

#endif
