// A drawn surface on the device: what whoever draws it needs to know.
#pragma once

#include "gpu/device.h"

#include <cstdint>

namespace weft::gpu {

/// Part of a buffer; that of an array that is not there has no buffer.
struct BufferRange {
    VkBuffer buffer = VK_NULL_HANDLE;
    std::uint64_t offset = 0, size = 0;  ///< bytes
    std::uint64_t address = 0;           ///< on the device, of the first element
};

struct SurfaceBuffers {
    BufferRange positions;  ///< four floats a vertex: m, and 1
    BufferRange normals;    ///< four floats a vertex: unit, and 0
    BufferRange tangents;   ///< four floats a vertex: unit, and the handedness; only with UVs
    BufferRange uvs;        ///< two floats a vertex; only with UVs
    BufferRange triangles;  ///< three indices a triangle, 32 bits each
    std::uint32_t vertex_count = 0, triangle_count = 0;
    std::uint64_t topology_version = 1;  ///< another number whenever the triangles have changed
    Moment ready;                        ///< from here on they hold what they should
};

}  // namespace weft::gpu
