// Arguments of the passes of dynamic lists, shared by C++ and GLSL.
#ifndef WEFT_VULKAN_LISTS_ARGS_H
#define WEFT_VULKAN_LISTS_ARGS_H

#include "vulkan/args.data.h"

// Words of ListArgs::head: workgroups along three axes, as an indirect dispatch reads them, then the number of
// constraints in the frame, including those without room.
#define WEFT_LIST_WANTED 3
#define WEFT_LIST_HEAD_WORDS 4

#ifdef __cplusplus
namespace weft::vulkan {
using ListMemberRef = std::uint64_t;
#else
layout(buffer_reference) buffer ListMemberRef;
#endif

// A cloth of a list. Its particles are the list's items from `first` on.
struct ListMemberIn {
    FrameRef frame;
    CollidersRef colliders;
    Uints report;
    uint base;  // its first particle in the world
    uint first;
};

struct ListArgs {
    ListMemberRef members;
    Vec4s position;  // of the world
    Uints places;    // items + 1: from the second on, constraints per item; after the scan, where an item's rows begin
    Uints particles;  // [row], likewise share, targets and corrections
    Floats fields;    // [field · stride + row]
    Floats share;
    Vec4s targets;  // point in the collider's frame of reference, number of the collider
    Vec4s corrections;
    Uints head;
    uint member_count;
    uint items;
    uint capacity;
    uint stride;
    uint substep;
    uint mean;      // 1: an item's correction is the mean of its rows, not their sum
    uint group;     // rows per workgroup
    uint widest;    // largest number of workgroups along an axis
    uint first;     // gather only: items [first, end)
    uint end;
};

#ifdef __cplusplus
}  // namespace weft::vulkan
#else
layout(buffer_reference, std430, buffer_reference_align = 16) buffer ListMemberRef {
    ListMemberIn at[];
};
#endif

#endif
