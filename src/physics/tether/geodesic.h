// Distances over a surface.
#pragma once

#include "mesh/topology.h"

#include <algorithm>
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

/// A way over the surface from a particle to one of several places.
struct Way {
    double distance = 0;          ///< m
    std::uint32_t place = none;   ///< its number
    std::uint32_t source = none;  ///< the particle of it that the way leads to
};

/// Of each particle up to `most` ways, each to another place, in no set order.
struct WaysToPlaces {
    std::uint32_t most = 0;
    std::vector<Way> ways;  ///< [most · particle + i]; those without a place come last

    std::span<const Way> operator[](std::uint32_t particle) const {
        const auto all = std::span(ways).subspan(std::size_t{most} * particle, most);
        return all.first(static_cast<std::size_t>(std::ranges::find(all, none, &Way::place) - all.begin()));
    }
};

/// Distances as above to the nearest `most` places that a particle can reach; no particle is of two places.
/// All fronts march at once, and none goes on where `most` others have been: the work does not grow with the number of
/// places. A front that ends there has lost a neighbor on its border, so the last of a particle's ways may be longer
/// than with a larger `most`, by a part of an edge.
WaysToPlaces ways_to_places(const Topology& topology, std::span<const std::vector<std::uint32_t>> places,
                            std::uint32_t most);

}  // namespace weft
