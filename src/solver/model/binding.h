// Binding of a render mesh to the simulated mesh, which is usually coarser.
#pragma once

#include "base/shared_array.h"
#include "collide/closest_point.h"
#include "mesh/topology.h"

#include <weft/vector.h>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace weft {

/// One vertex of the render mesh, bound to a triangle of the simulated mesh by a local frame. The origin of the frame
/// is the bound point on the curved triangle. Its third axis is the interpolated normal. Its first axis is the first
/// side of the triangle, projected to the plane perpendicular to the third.
struct BoundVertex {
    std::array<std::uint32_t, 3> particles{};  ///< corners of the triangle
    std::array<float, 2> weights{};            ///< barycentric, of the last two corners; the first is 1 minus both
    Vec3 offset;                               ///< m, in the frame: from the curved triangle to the vertex
    Vec3 normal;                               ///< unit, in the frame
};

struct Binding {
    SharedArray<BoundVertex> vertices;  ///< one per vertex of the render mesh
    float farthest = 0;                 ///< m: largest distance of a vertex from the simulated surface at rest

    bool empty() const { return vertices.empty(); }
};

/// Binds points to triangles of the simulated mesh at rest. Keeps a reference to the topology.
class Binder {
  public:
    explicit Binder(const Topology& topology);

    SurfacePoint closest(Vec3 position) const { return search_.closest(position); }
    /// `weights`: barycentric, of the bound point. `normal`: unit, or zero for that of the surface.
    BoundVertex bind(Vec3 position, Vec3 normal, std::uint32_t triangle, const std::array<double, 3>& weights) const;
    /// Binds to the closest point of the triangle. Returns the squared distance from it, m².
    double bind_to(std::uint32_t triangle, Vec3 position, Vec3 normal, BoundVertex& bound) const;

  private:
    const Topology& topology_;
    std::vector<Vec4> positions_, normals_;
    SurfaceSearch search_;
};

/// The normals of a render mesh, or those of its shape if it has none: smooth across seams, zero where the triangles
/// define none.
std::vector<Vec3> normals_to_draw(const TriangleMesh& mesh);

/// Binds every vertex of the render mesh to the closest triangle at rest, with normals_to_draw(). Its positions must be
/// finite.
Binding bind_mesh(const TriangleMesh& drawn, const Topology& topology);

/// Computes positions (m) and unit normals of the render vertices from those of the particles. At rest the result is
/// the mesh that was bound. A rigid motion of the particles moves the mesh rigidly. The surface stays continuous for
/// all positions of the particles if the render mesh lies on the curved triangles at rest.
void follow(const Binding& binding, std::span<const Vec4> positions, std::span<const Vec4> normals,
            std::vector<Vec3>& drawn_positions, std::vector<Vec3>& drawn_normals);

}  // namespace weft
