// Geodesic distances over a surface.
#pragma once

#include "mesh/topology.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace weft {

struct Geodesic {
    std::vector<float> distance;         ///< per particle, m; infinite if no path exists
    std::vector<std::uint32_t> nearest;  ///< per particle: the source it was reached from, or `none`
};

/// Geodesic distance at rest from the nearest of the sources, by fast marching over triangles (Kimmel, Sethian 1998).
/// Exact across flat regions of acute or right triangles up to first order in the edge length. In obtuse triangles it
/// falls back to the path along edges, which is longer, never shorter.
Geodesic geodesic_distance(const Topology& topology, std::span<const std::uint32_t> sources);

/// A geodesic distance from a particle to one of several places.
struct Way {
    double distance = 0;          ///< m
    std::uint32_t place = none;   ///< its number
    std::uint32_t source = none;  ///< the particle of that place where the geodesic starts
};

/// For each particle up to `most` geodesics, each to a different place, in unspecified order.
struct WaysToPlaces {
    std::uint32_t most = 0;
    std::vector<Way> ways;  ///< [most · particle + i]; entries without a place come last

    std::span<const Way> operator[](std::uint32_t particle) const {
        const auto all = std::span(ways).subspan(std::size_t{most} * particle, most);
        return all.first(static_cast<std::size_t>(std::ranges::find(all, none, &Way::place) - all.begin()));
    }
};

/// Geodesic distances to the nearest `most` places that a particle can reach. No particle may belong to two places. All
/// fronts march simultaneously, and none continues where `most` others have passed, so the work does not grow with the
/// number of places. A stopped front lacks a neighbor on its border, so the last of a particle's distances may be
/// longer than with a larger `most`, by a part of an edge.
WaysToPlaces ways_to_places(const Topology& topology, std::span<const std::vector<std::uint32_t>> places,
                            std::uint32_t most);

}  // namespace weft
