// Cuts a render mesh along the edges of the simulated mesh, so that it can part where they open.
#pragma once

#include "mesh/topology.h"

#include <cstdint>
#include <vector>

namespace weft {

/// A mesh whose triangles each lie in one simulated triangle.
struct ClippedMesh {
    TriangleMesh mesh;                       ///< the vertices of the render mesh, then those at the cuts
    std::vector<std::uint32_t> triangle_of;  ///< per triangle: the simulated triangle in which it lies
    std::uint32_t left_whole = 0;            ///< pieces that reach into other simulated triangles, see below
};

/// Cuts each triangle of `drawn` into pieces, one or more for each simulated triangle over which it lies. Simulated
/// triangles are separated by the planes through their common edge that contain the mean of both normals. What lies
/// beyond the rim of the cloth belongs to the triangle at the rim, and so does what lies beyond an edge that is folded
/// sharply. The mesh keeps its shape: pieces share their vertices, also across the edges of `drawn`. Values of new
/// vertices are interpolated linearly; normals have length 1.
///
/// The search for pieces starts at the simulated triangle closest to the middle of the drawn one and goes from neighbor
/// to neighbor. Far from the surface the planes of a triangle may not enclose anything. A piece that comes back to a
/// triangle on its way stays there as it is. So nothing is lost.
ClippedMesh clip_to_triangles(const TriangleMesh& drawn, const Topology& topology);

}  // namespace weft
