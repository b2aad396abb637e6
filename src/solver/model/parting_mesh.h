// How the drawn mesh of a cloth parts where edges of its simulated mesh are opened. Needed if the drawn mesh is not the
// simulated one, vertex by vertex.
#pragma once

#include "mesh/triangle_mesh.h"
#include "mesh/triangle_view.h"
#include "solver/model/binding.h"
#include "solver/model/clipped_mesh.h"

#include <array>
#include <cstdint>
#include <vector>

namespace weft {

/// The drawn mesh of a cloth that can be cut or torn, as it was built. Triangles keep their number and order; vertices
/// are appended to those that were built. The result of parted() depends only on the current triangles, not on the
/// order in which their edges were opened. While the number of vertices stays the same, so do the drawn triangles.
class PartingMesh {
  public:
    /// Drawn triangle and simulated triangle of the same number have the same corners. `vertex_to_particle`: as in
    /// Topology. `room`: number of particles that can be appended.
    PartingMesh(TriangleMesh mesh, std::vector<std::uint32_t> vertex_to_particle, std::uint32_t room);
    /// A render mesh of its own, with normals.
    PartingMesh(ClippedMesh clipped, const Topology& topology);

    struct Parted {
        TriangleMesh mesh;                              ///< at rest, without normals
        std::vector<std::uint32_t> vertex_to_particle;  ///< empty with a binding
        Binding binding;                                ///< empty without a render mesh of its own
    };
    /// `triangles`: those of the particles, now. A vertex shows the particle at its first corner; each other particle
    /// among its corners gets a vertex of its own, with the same rest position, UV and color. A vertex of a bound mesh
    /// is bound to one of the simulated triangles in which its corners lie. It parts where these no longer hang
    /// together. Drawn triangles of a removed triangle have one vertex at all their corners.
    Parted parted(TriangleView triangles) const;

    const TriangleMesh& built() const { return mesh_; }
    std::size_t most_appended() const { return most_appended_; }  ///< vertices, at most; an upper bound

  private:
    /// A vertex in a simulated triangle. Uses are sorted by vertex, then by triangle.
    struct Use {
        std::uint32_t vertex, triangle;
        BoundVertex bound;  ///< to this triangle
    };
    /// Two uses of a vertex hang together while both pairs of corners are the same particle.
    struct Joint {
        std::uint32_t a, b;  ///< uses
        struct Corner {
            std::uint32_t triangle, slot;
        };
        std::array<std::array<Corner, 2>, 2> pairs;
    };
    void list_uses(const std::vector<std::uint32_t>& triangle_of, const Binder& binder);
    void bind_uses(const std::vector<Vec3>& normals, const Binder& binder);
    void join(std::uint32_t first, std::uint32_t last, const Topology& topology);
    std::vector<std::uint32_t> joined_uses(TriangleView triangles) const;

    TriangleMesh mesh_;
    std::vector<std::uint32_t> vertex_to_particle_;  // without a binding
    std::vector<Use> uses_;                          // with a binding
    std::vector<Triangle> use_of_corner_;            // per drawn triangle
    std::vector<Joint> joints_;
    float farthest_ = 0;  // m, Binding::farthest
    std::size_t most_appended_ = 0;
};

}  // namespace weft
