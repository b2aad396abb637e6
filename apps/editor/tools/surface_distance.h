// Distances over a mesh, from a point of it up to a radius.
#pragma once

#include "base/lowest_first.h"
#include "editor/tools/mesh_view.h"
#include "mesh/grouping.h"

#include <cstdint>
#include <span>
#include <vector>

namespace weft::editor {

/// A point in a triangle.
struct MeshPlace {
    std::uint32_t triangle = 0;
    Vec3 weights{1, 0, 0};  ///< barycentric
};

struct ReachedVertex {
    std::uint32_t vertex = 0;
    float distance = 0;  ///< m
};

/// By fast marching, as physics/tether/geodesic.h does for whole meshes at rest. On a flat grid never too short, and
/// too long by a fifth of an edge at most. Keeps the connections of the triangles, so it must be made anew when the
/// triangles change; positions may change.
class SurfaceDistance {
  public:
    explicit SurfaceDistance(const MeshView& mesh);

    /// The vertices within the radius (m), by ascending distance. `mesh`: the same triangles. Empty if the place is not
    /// on a sound triangle. The result is valid until the next call.
    std::span<const ReachedVertex> from(const MeshView& mesh, const MeshPlace& place, float radius);

    /// Vertices that share an edge with the vertex, ascending.
    std::span<const std::uint32_t> neighbors(std::uint32_t vertex) const {
        return std::span(neighbors_.items)
            .subspan(neighbors_.offsets[vertex], neighbors_.offsets[vertex + 1] - neighbors_.offsets[vertex]);
    }
    std::uint32_t vertices() const { return static_cast<std::uint32_t>(distance_.size()); }

  private:
    void offer(std::uint32_t vertex, double distance);

    std::uint32_t triangles_ = 0;
    Groups<std::uint32_t> sectors_;  // triangles at each vertex
    Groups<std::uint32_t> neighbors_;
    LowestFirst queue_;
    std::vector<double> distance_;  // infinite unless the current search has reached the vertex
    std::vector<std::uint8_t> final_;
    std::vector<ReachedVertex> reached_;
    double radius_ = 0;
};

/// The point in the world; weights need not sum up to 1 exactly.
Vec3 point_of(const MeshView& mesh, const MeshPlace& place);

}  // namespace weft::editor
