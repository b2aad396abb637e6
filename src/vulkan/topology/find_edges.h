// Unique edges and hinges of a triangle list, found on the device.
#pragma once

#include "gpu/device.h"
#include "mesh/edges.h"
#include "vulkan/programs.h"

#include <cstdint>
#include <span>

namespace weft::vulkan {

struct EdgeTimes {
    double device_ms = 0;  ///< of the passes, without transfers; 0 if the device has no clock
    double wall_ms = 0;    ///< total: allocation, upload of triangles, passes, download of lists
};

/// Returns the same lists in the same order as build_edges and build_hinges (mesh/edges.h). Corners must be
/// < vertex_count.
Result<EdgesAndHinges> build_edges_and_hinges(gpu::Device& device, Programs& programs,
                                              std::span<const Triangle> triangles, std::uint32_t vertex_count,
                                              EdgeTimes* times = nullptr);

}  // namespace weft::vulkan
