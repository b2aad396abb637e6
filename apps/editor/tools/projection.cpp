#include "editor/tools/projection.h"

#include "look/view_limits.h"

#include <algorithm>
#include <numbers>

namespace weft::editor {

Projection::Projection(const Camera& camera, Vec2 size) : camera_(camera), size_(size) {
    if (!finite(camera.position) || !finite(camera.target) || !finite(size) || !(size.x > 0) || !(size.y > 0)) return;
    if (!(camera.fov > 0) || !(camera.fov < 180)) return;
    eye_ = exact(camera.position);
    const Double3 along = exact(camera.target) - eye_;
    const double distance = length(along);
    ahead_ = normalized(along);
    right_ = normalized(cross(ahead_, exact(image_up(camera))));
    down_ = cross(ahead_, right_);
    if (!(distance > 0) || !(length(right_) > 0)) return;
    center_ = exact(size) * 0.5;
    focal_ = center_.y / std::tan(static_cast<double>(camera.fov) * std::numbers::pi / 360);
    nearest_ = static_cast<double>(near_plane) * std::max(distance, static_cast<double>(least_target_distance));
    valid_ = true;
}

std::optional<Ray> Projection::ray(Vec2 pixel) const {
    if (!valid_ || !finite(pixel)) return std::nullopt;
    return Ray{camera_.position, rounded(normalized(direction_to_world(direction_at(exact(pixel)))))};
}

std::optional<ScreenPoint> Projection::project(Vec3 world) const {
    if (!valid_ || !finite(world)) return std::nullopt;
    const Double3 view = to_view(exact(world));
    if (!(view.z >= nearest_)) return std::nullopt;
    return ScreenPoint{rounded(pixel_of(view)), static_cast<float>(view.z)};
}

Vec3 Projection::at(Vec2 pixel, double depth) const {
    return rounded(to_world(direction_at(exact(pixel)) * depth));
}

}  // namespace weft::editor
