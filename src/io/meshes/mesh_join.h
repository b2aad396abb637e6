// From the loose corners that importers produce to a mesh whose triangles share vertices.
#pragma once

#include "mesh/triangle_mesh.h"

#include <cstdint>
#include <span>

namespace weft {

/// Joins vertices that are the same in every attribute, bit for bit. Each keeps the place of its first appearance.
TriangleMesh joined(const TriangleMesh& mesh);

/// Puts vertices in the order of the source points that they stand for (`source[i]` for vertex i), with the positions
/// and colors of those points (`colors` may be empty), adds the points that no vertex stands for, and joins the
/// vertices of one point that are the same. Points are never joined with each other.
TriangleMesh in_source_order(const TriangleMesh& mesh, std::span<const std::uint32_t> source,
                             std::span<const Vec3> positions, std::span<const Vec4> colors);

}  // namespace weft
