// Handles that move, turn and scale an object: arrows, squares and rings of constant size in pixels.
#pragma once

#include "editor/tools/gizmo_drag.h"
#include "editor/tools/projection.h"

#include <vector>

namespace weft::editor {

struct GizmoStyle {
    float size = 90;      ///< pixels from the center to the tip of an arrow that lies in the plane of the image
    float tolerance = 8;  ///< pixels beside a handle that still belong to it
};

/// A line or a filled polygon to draw, in pixels.
struct GizmoShape {
    GizmoHandle handle{};
    int axis = 3;  ///< 0, 1, 2: in the color of x, y or z; 3: white
    std::vector<Vec2> points = {};
    bool filled = false;  ///< a convex polygon, else a line
    bool closed = false;  ///< the line's end is connected to its start
    bool faint = false;   ///< the half of a ring that faces away, an axis that is seen end on
    bool highlighted = false;
    float depth = 0;  ///< m
};

/// The handles at one pose of an object.
class Gizmo {
  public:
    Gizmo(const Projection& view, const GizmoPlace& place, GizmoKind kind, GizmoAxes axes,
          const GizmoStyle& style = {});

    /// Whether the object is in front of the camera. Else there is nothing to draw or to pick.
    bool visible() const { return !parts_.empty(); }
    /// The handle under the pointer: the nearest one in pixels; of several under it, the nearest to the eye.
    GizmoHandle handle_at(Vec2 pointer) const;
    /// Far ones first.
    std::vector<GizmoShape> shapes(GizmoHandle highlighted) const;
    /// Nothing without a handle, or if the pointer is not finite.
    std::optional<GizmoDrag> start_drag(GizmoHandle handle, Vec2 pointer) const;

  private:
    struct Part {
        GizmoShape shape;
        bool pickable = true;
    };
    void add_line(GizmoHandle handle, int axis, std::vector<Double3> points, bool pickable, bool faint);
    void add_square(GizmoHandle handle, int axis, Double3 center, double half);
    void add_arrows(GizmoHandle first, bool boxes);
    void add_planes();
    void add_ring(GizmoHandle handle, int axis, Double3 around, double radius);

    Projection view_;
    GizmoDragFrame frame_;
    GizmoStyle style_;
    Double3 center_;     // in the view's frame, m
    double meters_ = 0;  // per pixel at the center
    double size_ = 0;    // m
    std::vector<Part> parts_;
};

}  // namespace weft::editor
