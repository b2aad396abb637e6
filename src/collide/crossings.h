// Counts where surfaces pass through each other: the ground truth for collision handling, not part of the step.
#pragma once

#include "mesh/triangle_mesh.h"

#include <cstdint>
#include <span>

namespace weft {

struct Crossings {
    std::uint64_t triangles = 0;  ///< unordered pairs of triangles that intersect and share no particle
    std::uint64_t edges = 0;      ///< (unique edge, triangle) pairs that intersect and share no particle
};

/// All crossings within one set of triangles, whose indices must be in range. Exact up to rounding of the
/// double-precision orientation tests; triangles that only touch within that rounding may go either way: a particle
/// exactly on a triangle's plane counts as in front of it, so surfaces that pass through each other at their very
/// particles still cross, and a line through an edge meets one of its triangles. Triangles that overlap in one plane do
/// not cross. Degenerate triangles cross nothing, nor do those with a non-finite position. Deterministic. Expected time
/// O(n log n) for a cloth of n triangles.
Crossings count_crossings(std::span<const Vec3> positions, std::span<const Triangle> triangles);

}  // namespace weft
