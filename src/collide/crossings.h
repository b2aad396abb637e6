// Finds where surfaces pass through each other. This is the ground truth for collision handling.
#pragma once

#include "mesh/triangle_mesh.h"

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace weft {

struct Crossings {
    std::uint64_t triangles = 0;  ///< unordered pairs of triangles that intersect and share no particle
    std::uint64_t edges = 0;      ///< (unique edge, triangle) pairs that intersect and share no particle
};

/// Whether the triangles with two particles count as crossing if they do. An empty one: all do.
using CanCross = std::function<bool(std::uint32_t, std::uint32_t)>;

/// All crossings within one set of triangles, whose indices must be in range. Exact up to rounding of the
/// double-precision orientation tests; triangles that touch within that rounding may be counted or not. A particle
/// exactly on a triangle's plane counts as in front of it, so surfaces that pass through each other exactly at their
/// particles still cross; a line through an edge intersects one of its triangles. Coplanar triangles that overlap do
/// not cross. Degenerate triangles and those with a non-finite position cross nothing. Deterministic. Expected time O(n
/// log n) for a cloth of n triangles.
Crossings count_crossings(std::span<const Vec3> positions, std::span<const Triangle> triangles,
                          const CanCross& can_cross = {});

/// An edge, the particle of the lower number first, that intersects a triangle.
struct EdgeCrossing {
    std::array<std::uint32_t, 2> edge;
    std::uint32_t triangle;
    friend bool operator==(const EdgeCrossing&, const EdgeCrossing&) = default;
};

/// The crossings that `Crossings::edges` counts, sorted.
std::vector<EdgeCrossing> find_crossings(std::span<const Vec3> positions, std::span<const Triangle> triangles,
                                         const CanCross& can_cross = {});

}  // namespace weft
