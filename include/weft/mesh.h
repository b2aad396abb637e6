// Triangle meshes. A mesh keeps the vertices of seams and hard edges; the simulation welds them in a copy.
#pragma once

#include <weft/vector.h>

#include <array>
#include <cstdint>
#include <vector>

namespace weft {

/// Three vertex or particle indices, counter-clockwise seen from the front.
using Triangle = std::array<std::uint32_t, 3>;

/// Index of no element: a missing neighbor, a vertex without a particle.
inline constexpr std::uint32_t none = 0xffffffffu;

struct TriangleMesh {
    std::vector<Vec3> positions{};  ///< m
    std::vector<Vec2> uvs{};        ///< empty, or one per position; u runs along the warp
    std::vector<Vec3> normals{};    ///< empty, or one unit vector per position
    std::vector<Vec4> colors{};     ///< empty, or one linear RGBA per position, 0…1
    std::vector<Triangle> triangles{};
    friend bool operator==(const TriangleMesh&, const TriangleMesh&) = default;
};

}  // namespace weft
