// What a drag of a gizmo's handle does to the object. The result depends on the start of the drag and on the pointer
// alone, so no error adds up, and a canceled drag gives back the start to the bit.
#pragma once

#include "editor/tools/projection.h"

#include <array>
#include <cstdint>
#include <optional>

namespace weft::editor {

enum class GizmoKind : std::uint8_t { move, turn, scale };
enum class GizmoAxes : std::uint8_t { world, local };  ///< handles that scale always lie along the local axes

// clang-format off
enum class GizmoHandle : std::uint8_t {
    none,
    move_x, move_y, move_z,     ///< arrows
    move_yz, move_zx, move_xy,  ///< squares: in the plane of two axes
    move_view,                  ///< the center: in the plane of the image
    turn_x, turn_y, turn_z,     ///< rings
    turn_view,                  ///< the outer ring: about the axis to the eye
    scale_x, scale_y, scale_z,
    scale_all,                  ///< the center
};
// clang-format on

struct GizmoPlace {
    Vec3 position;          ///< m
    Vec3 rotation_degrees;  ///< R = Rz·Ry·Rx
    friend bool operator==(const GizmoPlace&, const GizmoPlace&) = default;
};

/// Steps of what a drag changes, from its start on; 0: no steps.
struct GizmoSnap {
    float length = 0.1f;  ///< m
    float angle = 15;     ///< degrees
    float factor = 0.1f;
};

struct GizmoChange {
    GizmoPlace place;
    Vec3 scale{1, 1, 1};  ///< factors along the local axes, from the start of the drag; > 0
    /// To show beside the pointer: meters along the axes of the gizmo, degrees in x, or factors.
    Vec3 amount;
};

/// The axes of a gizmo in the world, and where the object is.
struct GizmoDragFrame {
    GizmoPlace place;
    std::array<Double3, 3> axes;
};
/// A ring whose axis is so near to the line of sight (sine of the angle) has no half that faces away.
inline constexpr double ring_front = 0.1;
inline constexpr double outer_ring = 1.2;  ///< radius of the ring `turn_view`, in sizes of the gizmo
GizmoDragFrame gizmo_frame(const GizmoPlace& place, GizmoKind kind, GizmoAxes axes);

class GizmoDrag {
  public:
    /// `size`: of the gizmo in pixels.
    GizmoDrag(const Projection& view, const GizmoDragFrame& frame, GizmoHandle handle, Vec2 pointer, double size);

    GizmoHandle handle() const { return handle_; }
    /// Before the drag: what Esc gives back.
    const GizmoPlace& start() const { return frame_.place; }
    /// The object with the pointer at a pixel. A pointer that is not finite gives the start.
    ///
    ///  * An arrow or a square stays under the pointer: the point of it that was grabbed is there also after the move,
    ///    although the handles keep their size on the image while the object comes nearer or goes away. A drag toward a
    ///    vanishing point ends at 20 times the depth of the start, one toward the eye at a 20th. Along an axis or plane
    ///    that is seen within 6° of end on, the center moves with the pointer by as many meters as in the plane of the
    ///    image.
    ///  * A ring turns by the way of the pointer along the ring's tangent where it was grabbed, divided by the ring's
    ///    radius. Where the ring is seen end on, that is the tangent of its nearest point.
    ///  * A handle that scales stays under the pointer.
    GizmoChange at(Vec2 pointer, const GizmoSnap& snap = {0, 0, 0}) const;
    /// The same for typed numbers: meters along the handle's axes, degrees in x, or a factor per axis.
    GizmoChange by(Vec3 amount) const;

  private:
    Vec3 moved(Double2 way) const;
    double moved_along(Double3 axis, Double2 way) const;
    std::array<double, 2> moved_within(Double3 u, Double3 v, Double2 way) const;
    double turned(Double2 way) const;
    Vec3 scaled(Double2 way) const;
    void start_turn(Double2 pointer);

    Projection view_;
    GizmoDragFrame frame_;
    GizmoHandle handle_;
    Double2 pointer_;
    double size_;                  // pixels
    Double3 center_;               // in the view's frame
    std::array<Double3, 3> axes_;  // in the view's frame
    Double3 around_;               // of a ring, in the world
    Double2 tangent_;              // of a ring: the direction in which the grabbed point moves on the image
    double radius_ = 1;            // pixels, of a ring
};

}  // namespace weft::editor
