// The arrays of a mesh, wherever they are stored.
#pragma once

#include "mesh/triangle_mesh.h"
#include "mesh/triangle_view.h"

#include <weft/vector.h>

#include <cstddef>
#include <cstdint>
#include <span>

namespace weft::editor {

/// Positions and triangles of a TriangleMesh, or of a frame of a cloth. Does not own them. Positions need not be finite
/// and corners need not be in range: tools leave such triangles out.
class MeshView {
  public:
    MeshView() = default;
    MeshView(std::span<const Vec3> positions, std::span<const Triangle> triangles)
        : positions_(positions.empty() ? nullptr : &positions[0].x),
          step_(3),
          vertices_(static_cast<std::uint32_t>(positions.size())),
          listed_(triangles) {}
    MeshView(std::span<const Vec4> positions, TriangleView triangles)
        : positions_(positions.empty() ? nullptr : &positions[0].x),
          step_(4),
          vertices_(static_cast<std::uint32_t>(positions.size())),
          by_corner_(triangles) {}
    MeshView(std::span<const Vec4> positions, std::span<const Triangle> triangles)
        : positions_(positions.empty() ? nullptr : &positions[0].x),
          step_(4),
          vertices_(static_cast<std::uint32_t>(positions.size())),
          listed_(triangles) {}
    explicit MeshView(const TriangleMesh& mesh) : MeshView(std::span(mesh.positions), std::span(mesh.triangles)) {}

    std::uint32_t vertices() const { return vertices_; }
    std::uint32_t triangles() const {
        return listed_.empty() ? by_corner_.size() : static_cast<std::uint32_t>(listed_.size());
    }
    Vec3 position(std::uint32_t vertex) const {
        const float* p = positions_ + std::size_t{step_} * vertex;
        return {p[0], p[1], p[2]};
    }
    Triangle triangle(std::uint32_t t) const { return listed_.empty() ? by_corner_[t] : listed_[t]; }

    /// Whether its corners are vertices with finite positions.
    bool sound(const Triangle& t) const {
        return t[0] < vertices_ && t[1] < vertices_ && t[2] < vertices_ && finite(position(t[0])) &&
               finite(position(t[1])) && finite(position(t[2]));
    }

  private:
    const float* positions_ = nullptr;
    std::uint32_t step_ = 3, vertices_ = 0;  // floats per position
    std::span<const Triangle> listed_;
    TriangleView by_corner_;
};

}  // namespace weft::editor
