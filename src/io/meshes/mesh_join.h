// Joins the separate corners that importers produce into a mesh whose triangles share vertices.
#pragma once

#include "mesh/triangle_mesh.h"

#include <cstdint>
#include <span>

namespace weft {

/// Joins vertices that are bitwise equal in every attribute. Each keeps the place of its first appearance.
TriangleMesh joined(const TriangleMesh& mesh);

/// Orders vertices by their source points (`source[i]` for vertex i), sets the positions and colors of those points
/// (`colors` may be empty), adds the points that no vertex has as its source, and joins equal vertices of the same
/// point. Different points are never joined.
TriangleMesh in_source_order(const TriangleMesh& mesh, std::span<const std::uint32_t> source,
                             std::span<const Vec3> positions, std::span<const Vec4> colors);

}  // namespace weft
