// What the passes of the drawn surface are told, read by C++ and by GLSL. One invocation is one drawn vertex.
#ifndef WEFT_VULKAN_SURFACE_ARGS_H
#define WEFT_VULKAN_SURFACE_ARGS_H

#include "vulkan/args.data.h"

#ifdef __cplusplus
namespace weft::vulkan {
#endif

// Where drawn and simulated mesh are the same.
struct WeldedArgs {
    Vec4s position;
    Vec4s normals;
    Uints particle;  // of the vertex; 0xffffffff: it stays where it is
    Vec4s to_position;
    Vec4s to_normal;
    uint count;
    uint unused;
};

// Where the drawn mesh follows the simulated one.
struct BoundArgs {
    Vec4s position;
    Vec4s normals;
    Uints particles;  // three per vertex
    Vec4s shape;      // two per vertex: weights and offset, the normal behind them
    Vec4s to_position;
    Vec4s to_normal;
    uint count;
    uint unused;
};

struct TangentArgs {
    Vec4s position;  // as drawn
    Vec4s normal;
    Uints triangles;
    Floats uvs;     // two per vertex
    Uints offsets;  // of the lists of triangles at each vertex
    Uints items;
    Vec4s to_tangent;
    uint count;
    uint unused;
};

#ifdef __cplusplus
static_assert(sizeof(WeldedArgs) <= 128 && sizeof(BoundArgs) <= 128 && sizeof(TangentArgs) <= 128);
}  // namespace weft::vulkan
#endif

#endif
