// The buffers of a drawn surface on the device, for renderers.
#pragma once

#include "gpu/device.h"

#include <cstdint>

namespace weft::gpu {

/// Part of a buffer; without a buffer if the array does not exist.
struct BufferRange {
    VkBuffer buffer = VK_NULL_HANDLE;
    std::uint64_t offset = 0, size = 0;  ///< bytes
    std::uint64_t address = 0;           ///< on the device, of the first element
};

struct SurfaceBuffers {
    BufferRange positions;  ///< four floats per vertex: m, and 1
    BufferRange normals;    ///< four floats per vertex: unit vector, and 0
    BufferRange tangents;   ///< four floats per vertex: unit vector, and the handedness; only with UVs
    BufferRange uvs;        ///< two floats per vertex; only with UVs
    BufferRange triangles;  ///< three indices per triangle, 32 bits each
    std::uint32_t vertex_count = 0, triangle_count = 0;
    std::uint64_t topology_version = 1;  ///< changes whenever the triangles change
    Moment ready;                        ///< the buffers are valid from this time on
};

}  // namespace weft::gpu
