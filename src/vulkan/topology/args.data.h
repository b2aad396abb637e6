// Arguments of the passes that find edges, shared by C++ and GLSL.
#ifndef WEFT_VULKAN_TOPOLOGY_ARGS_H
#define WEFT_VULKAN_TOPOLOGY_ARGS_H

#include "vulkan/primitives/args.data.h"

#ifdef __cplusplus
namespace weft::vulkan {
#endif

struct SideArgs {
    Uints triangles;
    Uints high;
    Uints low;
    Uints value;
    uint count;  // triangles
    uint unused;
};

struct EdgeArgs {
    Uints high;  // sides, sorted
    Uints low;
    Uints value;
    // 1 at the first side of an edge, of a hinge, of an edge with three triangles or more; after the scan: the number
    // of ones before. One element more than there are sides.
    Uints heads;
    Uints hinges;
    Uints crowded;
    Uints triangles;
    Uints to_edges;
    Uints to_hinges;
    Uints to_crowded;
    Uints to_inconsistent;
    uint count;  // sides
    uint unused;
};

#ifdef __cplusplus
static_assert(sizeof(EdgeArgs) <= 128);
}  // namespace weft::vulkan
#endif

#endif
