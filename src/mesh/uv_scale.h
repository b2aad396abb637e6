// How large a mesh's UVs are on its surface.
#pragma once

#include "mesh/triangle_mesh.h"

#include <array>
#include <span>

namespace weft {

/// m of cloth that a unit of u and of v is long: |∂P/∂u| and |∂P/∂v|, means over the area. {1, 1} where there are no
/// UVs, or none that span an area.
std::array<float, 2> uv_meters(std::span<const Vec3> positions, std::span<const Vec2> uvs,
                               std::span<const Triangle> triangles);
inline std::array<float, 2> uv_meters(const TriangleMesh& mesh) {
    return uv_meters(mesh.positions, mesh.uvs, mesh.triangles);
}

}  // namespace weft
