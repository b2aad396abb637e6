// Where a point of a cloth goes that the pointer pulls: it stays in the plane through the grabbed point parallel to the
// image. The wheel moves the plane.
#pragma once

#include "editor/tools/projection.h"

#include <optional>

namespace weft::editor {

struct DragPlane {
    double depth = 0;  ///< m, along the direction of the view
    Vec2 offset;       ///< pixels, from the pointer to the grabbed point
};

/// Nothing if the point is not in front of the camera or the pointer is not finite.
std::optional<DragPlane> grab(const Projection& view, Vec3 point, Vec2 pointer);

/// The camera may have moved since grab(): the plane keeps its depth. Nothing if the pointer is not finite.
std::optional<Vec3> pulled_to(const DragPlane& plane, const Projection& view, Vec2 pointer);

/// Each notch moves the plane by a tenth of its depth: away from the eye if `notches` is positive, else toward it, at
/// most to twice the depth of the near plane.
DragPlane pushed(const DragPlane& plane, const Projection& view, float notches);

}  // namespace weft::editor
