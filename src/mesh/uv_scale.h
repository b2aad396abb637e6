// The size of a UV unit on a mesh's surface, in meters.
#pragma once

#include "mesh/triangle_mesh.h"

#include <array>
#include <span>

namespace weft {

/// Length on the cloth, in m, of a unit of u and of v: |∂P/∂u| and |∂P/∂v|, averaged over the area. {1, 1} if there are
/// no UVs, or none that span an area.
std::array<float, 2> uv_meters(std::span<const Vec3> positions, std::span<const Vec2> uvs,
                               std::span<const Triangle> triangles);
inline std::array<float, 2> uv_meters(const TriangleMesh& mesh) {
    return uv_meters(mesh.positions, mesh.uvs, mesh.triangles);
}

}  // namespace weft
