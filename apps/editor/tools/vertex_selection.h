// Vertices of a mesh by click, box and lasso.
#pragma once

#include "editor/tools/mesh_view.h"
#include "editor/tools/picking.h"
#include "editor/tools/projection.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace weft::editor {

/// Surfaces that hide vertices; usually the mesh itself is among them.
struct HiddenBy {
    PickScene scene;
    float tolerance = 1e-3f;  ///< m: surfaces so near in front of a vertex do not hide it
};

/// Inside a closed polygon: it winds around the pixel. A line that crosses itself encloses both loops. Corners that are
/// not finite are left out. Fewer than three corners enclose nothing.
class Lasso {
  public:
    explicit Lasso(std::span<const Vec2> polygon);
    bool contains(Vec2 pixel) const;

  private:
    struct Side {
        Double2 from, to;
    };
    std::size_t band_of(double y) const;

    Double2 min_, max_;
    double band_height_ = 1;
    std::vector<std::vector<Side>> bands_;  // sides by the rows of pixels that they cross
};

// Only vertices of triangles count, and only those in front of the camera. `hidden_by`: leaves hidden vertices out;
// null: all vertices count. Lists are ascending.

/// The vertex nearest to the pixel, within `radius` pixels; of several at one pixel the nearest to the eye.
std::optional<std::uint32_t> vertex_at(const Projection& view, const MeshView& mesh, Vec2 pixel, float radius,
                                       const HiddenBy* hidden_by);
/// Between two corners of a rectangle, its sides included.
std::vector<std::uint32_t> vertices_in_box(const Projection& view, const MeshView& mesh, Vec2 a, Vec2 b,
                                           const HiddenBy* hidden_by);
std::vector<std::uint32_t> vertices_in_lasso(const Projection& view, const MeshView& mesh,
                                             std::span<const Vec2> polygon, const HiddenBy* hidden_by);

}  // namespace weft::editor
