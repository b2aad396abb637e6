// Welding: render vertices at the same place become one point of the simulated mesh.
#pragma once

#include <weft/vector.h>

#include <cstdint>
#include <span>
#include <vector>

namespace weft {

struct Weld {
    /// Render vertex -> welded vertex. Welded vertices are numbered by first appearance.
    std::vector<std::uint32_t> vertex_to_welded;
    /// Welded vertex -> its first render vertex, whose position it takes. Ascending.
    std::vector<std::uint32_t> first_vertex;
};

/// In order of their numbers, each vertex is merged into the earliest kept vertex no farther away than `distance` (m),
/// or is kept. So two kept vertices are always farther apart than `distance`, and chains of near vertices do not
/// collapse into one point. With 0 only equal positions are merged (-0 equals +0). Positions must be finite; `distance`
/// must be >= 0 and may be infinite. Linear in the number of vertices for every distance.
Weld weld_vertices(std::span<const Vec3> positions, float distance);

}  // namespace weft
