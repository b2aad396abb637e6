// From pixels of the view to the world and back.
#pragma once

#include "editor/tools/double3.h"
#include "look/camera.h"

#include <weft/vector.h>

#include <optional>

namespace weft::editor {

/// Points origin + t · direction, t ≥ 0.
struct Ray {
    Vec3 origin;     ///< m
    Vec3 direction;  ///< unit
};

/// A point of the world in the view.
struct ScreenPoint {
    Vec2 pixel;
    float depth = 0;  ///< m, along the direction of the view
};

/// A camera and the size of its view in pixels. Pixels are counted from the view's upper left corner, x to the right
/// and y down. The image is that of the renderer. Without a direction (eye at the target), without pixels, or if
/// something is not finite, it is not valid; then no pixel has a ray and no point a pixel.
class Projection {
  public:
    Projection(const Camera& camera, Vec2 size);

    bool valid() const { return valid_; }
    const Camera& camera() const { return camera_; }
    Vec2 size() const { return size_; }

    /// From the eye through a pixel, which may lie outside the view.
    std::optional<Ray> ray(Vec2 pixel) const;
    /// Nothing for points nearer than the near plane, or behind the eye. The pixel may lie outside the view.
    std::optional<ScreenPoint> project(Vec3 world) const;
    /// The point that is seen at a pixel at that depth in m.
    Vec3 at(Vec2 pixel, double depth) const;
    double pixels_per_meter(double depth) const { return focal_ / depth; }
    double nearest_depth() const { return nearest_; }  ///< m, of the near plane

    Vec3 right() const { return rounded(right_); }
    Vec3 down() const { return rounded(down_); }
    Vec3 ahead() const { return rounded(ahead_); }

    // For geometry in the view's own frame: x to the right and y down in the image, z ahead; the eye is the origin.
    Double3 to_view(Double3 world) const { return direction_to_view(world - eye_); }
    Double3 direction_to_view(Double3 v) const { return {dot(v, right_), dot(v, down_), dot(v, ahead_)}; }
    Double3 direction_to_world(Double3 v) const { return right_ * v.x + down_ * v.y + ahead_ * v.z; }
    Double3 to_world(Double3 view) const { return eye_ + direction_to_world(view); }
    Double2 pixel_of(Double3 view) const { return center_ + Double2{view.x / view.z, view.y / view.z} * focal_; }
    /// Through a pixel, with z = 1.
    Double3 direction_at(Double2 pixel) const {
        return {(pixel.x - center_.x) / focal_, (pixel.y - center_.y) / focal_, 1};
    }
    double focal() const { return focal_; }  ///< pixels: of a length of 1 at depth 1
    Double3 eye() const { return eye_; }

  private:
    Camera camera_;
    Vec2 size_;
    bool valid_ = false;
    Double3 eye_, right_, down_, ahead_;
    Double2 center_;
    double focal_ = 1, nearest_ = 0;
};

}  // namespace weft::editor
