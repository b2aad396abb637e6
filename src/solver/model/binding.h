// A drawn mesh that follows a coarser, simulated one.
#pragma once

#include "base/shared_array.h"
#include "mesh/topology.h"

#include <weft/vector.h>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace weft {

/// One vertex of the drawn mesh, held to a triangle of the simulated one. There stands a frame: its origin is the bound
/// point on the curved triangle, its third axis the interpolated normal, its first axis the triangle's first side, laid
/// into the plane of the other two.
struct BoundVertex {
    std::array<std::uint32_t, 3> particles{};  ///< corners of the triangle
    std::array<float, 2> weights{};            ///< barycentric, of the last two corners; the first has the rest
    Vec3 offset;                               ///< m, in the frame: what the curved triangle lacks
    Vec3 normal;                               ///< unit, in the frame
};

struct Binding {
    SharedArray<BoundVertex> vertices;  ///< one per vertex of the drawn mesh
    float farthest = 0;                 ///< m: largest distance of a drawn vertex from the simulated surface at rest

    bool empty() const { return vertices.empty(); }
};

/// Binds every vertex to the triangle that is closest to it at rest. The drawn mesh keeps its own normals, if it has
/// them, else those of its shape. Its positions must be finite.
Binding bind_mesh(const TriangleMesh& drawn, const Topology& topology);

/// Where the drawn vertices are and what their unit normals are, for positions and unit normals of the particles. What
/// `bind_mesh` saw comes out as it went in; a rigid motion of the particles moves all with it; and the surface is
/// continuous wherever the particles go, as far as the drawn mesh lies on the curved one.
void follow(const Binding& binding, std::span<const Vec4> positions, std::span<const Vec4> normals,
            std::vector<Vec3>& drawn_positions, std::vector<Vec3>& drawn_normals);

}  // namespace weft
