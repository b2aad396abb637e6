// The triangles of a drawn mesh that the simulation can use: none without area, none twice.
#pragma once

#include "mesh/triangle_mesh.h"

#include <cstdint>
#include <span>
#include <vector>

namespace weft {

/// A triangle whose height over its longest side is at most this fraction of that side has no area. Wide enough to
/// catch three corners on a line after their rounding to float (relative 6e-8 a coordinate), and a thousand times
/// thinner than slivers that scanned and decimated meshes hold on purpose.
inline constexpr double zero_area_ratio = 1e-6;

/// True with two equal corners too.
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
