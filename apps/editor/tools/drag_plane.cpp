#include "editor/tools/drag_plane.h"

#include <algorithm>

namespace weft::editor {
namespace {

constexpr double plane_step = 0.9, farthest_plane = 1e5;  // per notch; m

}  // namespace

std::optional<DragPlane> grab(const Projection& view, Vec3 point, Vec2 pointer) {
    const auto seen = view.project(point);
    if (!seen || !finite(pointer)) return std::nullopt;
    return DragPlane{static_cast<double>(seen->depth), seen->pixel - pointer};
}

std::optional<Vec3> pulled_to(const DragPlane& plane, const Projection& view, Vec2 pointer) {
    if (!view.valid() || !finite(pointer)) return std::nullopt;
    return view.at({pointer.x + plane.offset.x, pointer.y + plane.offset.y}, plane.depth);
}

DragPlane pushed(const DragPlane& plane, const Projection& view, float notches) {
    if (!std::isfinite(notches)) return plane;
    DragPlane to = plane;
    const double depth = plane.depth * std::pow(plane_step, -static_cast<double>(notches));
    to.depth = std::clamp(depth, 2 * view.nearest_depth(), std::max(farthest_plane, plane.depth));
    return to;
}

}  // namespace weft::editor
