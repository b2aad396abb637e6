// Triangles of a flat polygon.
#pragma once

#include "mesh/triangle_mesh.h"

#include <array>
#include <span>
#include <vector>

namespace weft {

/// Divides a convex polygon, counter-clockwise, into triangles of its corners. Corners may lie in the middle of a side.
/// Of all divisions it takes the one whose worst triangle is best: area over the sum of squared sides. The triangles of
/// a polygon of more than 64 corners share one corner instead.
std::vector<Triangle> triangulate_polygon(std::span<const std::array<double, 2>> corners);

}  // namespace weft
