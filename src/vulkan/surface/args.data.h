// Arguments of the passes of the drawn surface, shared by C++ and GLSL. One invocation handles one drawn vertex.
#ifndef WEFT_VULKAN_SURFACE_ARGS_H
#define WEFT_VULKAN_SURFACE_ARGS_H

#include "vulkan/args.data.h"

#ifdef __cplusplus
namespace weft::vulkan {
#endif

// For a drawn mesh that is the simulated mesh.
struct WeldedArgs {
    Vec4s position;
    Vec4s normals;
    Uints particle;  // of the vertex; 0xffffffff: the vertex never moves
    Vec4s to_position;
    Vec4s to_normal;
    uint count;
    uint unused;
};

// For a drawn mesh that follows the simulated one.
struct BoundArgs {
    Vec4s position;
    Vec4s normals;
    Uints particles;  // three per vertex
    Vec4s shape;      // two per vertex: weights and offset, then the normal
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
