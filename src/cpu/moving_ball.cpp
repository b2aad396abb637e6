#include "cpu/moving_ball.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace weft::cpu {

// A shape whose surface has at least a radius of curvature is a smaller shape, and all that is within that radius of
// it.
float ball_radius(const Collider& collider) {
    constexpr float unknown = std::numeric_limits<float>::infinity();
    if (collider.shape == ShapeKind::plane || collider.shape == ShapeKind::mesh) return unknown;
    const auto far = [&](float low, float high) {
        return std::max(std::max(std::abs(low), std::abs(high)) - collider.roundness, 0.0f);
    };
    const Bounds& box = collider.bounds;
    const Vec3 corner{far(box.min.x, box.max.x), far(box.min.y, box.max.y), far(box.min.z, box.max.z)};
    return length(corner) + collider.roundness;
}

// The difference of two rotations by an angle t apart is a matrix of norm 2 sin(t/2), and of Frobenius norm √2 times
// that.
MovingBall moving_ball(const Collider& collider, float radius, const Pose& before, const Pose& now, float widest) {
    const Vec3 x = now.rotation.x - before.rotation.x, y = now.rotation.y - before.rotation.y,
               z = now.rotation.z - before.rotation.z;
    return {.center = now.position,
            .radius = radius,
            .way = now.position - before.position,
            .turn = 0.70711f * std::sqrt(dot(x, x) + dot(y, y) + dot(z, z)),
            .steepness = steepness_of(collider),
            .widest = widest};
}

}  // namespace weft::cpu
