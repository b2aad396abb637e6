// Distances over a surface.
#pragma once

#include "mesh/topology.h"

#include <cstdint>
#include <span>
#include <vector>

namespace weft {

struct Geodesic {
    std::vector<float> distance;         ///< per particle, m; infinite where no way leads
    std::vector<std::uint32_t> nearest;  ///< per particle: the source it was reached from, or `none`
};

/// Distance over the surface at rest from the nearest of the sources, by fast marching over triangles (Kimmel, Sethian
/// 1998). Exact across flat regions of acute or right triangles up to first order in the edge length; where a triangle
/// is obtuse it falls back to the way along edges, which is longer, never shorter.
Geodesic geodesic_distance(const Topology& topology, std::span<const std::uint32_t> sources);

}  // namespace weft
