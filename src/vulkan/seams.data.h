// Distances at rest through stitches (Seams of collide/seams.h), shared by C++ and GLSL.
#ifndef WEFT_VULKAN_SEAMS_H
#define WEFT_VULKAN_SEAMS_H

#include "vulkan/args.data.h"

#ifdef __cplusplus
namespace weft::vulkan {
using SeamEntryRef = std::uint64_t;
}  // namespace weft::vulkan
#else
struct SeamEntryIn {
    uint seam;
    uint side;
    float distance;  // m
};
layout(buffer_reference, std430, buffer_reference_align = 4) readonly buffer SeamEntryRef {
    SeamEntryIn at[];
};

// `first`: by particle of the world.
float seam_distance(Uints first, SeamEntryRef entries, uint p, uint q)
{
    float least = 1e30;  // Seams::far
    for (uint i = first.at[p]; i < first.at[p + 1u]; ++i) {
        for (uint k = first.at[q]; k < first.at[q + 1u]; ++k) {
            SeamEntryIn a = entries.at[i], b = entries.at[k];
            if (a.seam == b.seam && a.side != b.side) least = min(least, a.distance + b.distance);
        }
    }
    return least;
}
#endif

#endif
