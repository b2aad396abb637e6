// Selects the triangles of a render mesh that the simulation can use: no zero-area triangles, no duplicates.
#pragma once

#include "mesh/triangle_mesh.h"

#include <cstdint>
#include <span>
#include <vector>

namespace weft {

/// A triangle counts as zero-area if its height over its longest side is at most this fraction of that side. The limit
/// is large enough to catch three collinear corners after rounding to float (relative 6e-8 per coordinate), and a
/// thousand times thinner than the slivers that scanned and decimated meshes contain on purpose.
inline constexpr double zero_area_ratio = 1e-6;

/// Also true if two corners are equal.
bool has_zero_area(Vec3 a, Vec3 b, Vec3 c);

struct SoundTriangles {
    std::vector<Triangle> triangles;             ///< in the order of the input, corners in their order
    std::vector<std::uint32_t> source_triangle;  ///< -> index in the input
    std::uint32_t degenerate = 0;                ///< left out: two corners the same, or zero area
    std::uint32_t duplicate = 0;                 ///< left out: the same three corners as an earlier one, in any order
};

/// Corners index `positions`.
SoundTriangles sound_triangles(std::span<const Triangle> triangles, std::span<const Vec3> positions);

}  // namespace weft
