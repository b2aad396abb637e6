// How the drawn mesh of a cloth parts where edges of its simulated mesh are opened. Needed if the drawn mesh is not the
// simulated one, vertex by vertex.
#pragma once

#include "mesh/triangle_mesh.h"
#include "mesh/triangle_view.h"

#include <cstdint>
#include <vector>

namespace weft {

/// The drawn mesh of a cloth that can be cut or torn, as it was built. Triangles keep their number and order, and
/// vertices are only appended. The result of parted() depends only on the current triangles, not on the order in which
/// their edges were opened.
class PartingMesh {
  public:
    /// Drawn triangle and simulated triangle of the same number have the same corners. `vertex_to_particle`: as in
    /// Topology. `room`: number of particles that can be appended.
    PartingMesh(TriangleMesh mesh, std::vector<std::uint32_t> vertex_to_particle, std::uint32_t room);

    struct Parted {
        TriangleMesh mesh;  ///< at rest, without normals
        std::vector<std::uint32_t> vertex_to_particle;
    };
    /// `triangles`: those of the particles, now. A vertex shows the lowest particle among its corners; each other
    /// particle gets a vertex of its own, with the same rest position, UV and color.
    Parted parted(TriangleView triangles) const;

    const TriangleMesh& built() const { return mesh_; }
    std::size_t most_appended() const { return most_appended_; }  ///< vertices, at most; an upper bound

  private:
    TriangleMesh mesh_;
    std::vector<std::uint32_t> vertex_to_particle_;
    std::size_t most_appended_ = 0;
};

}  // namespace weft
