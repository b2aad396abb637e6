// Tapered capsule along the collider's y axis. Scene keys; the math is in tapered_capsule.kernel.h.
#pragma once

#include "physics/contact/shape.h"

#include <algorithm>
#include <cmath>

namespace weft {

inline constexpr std::string_view tapered_capsule_what = "two balls on the collider's y axis and the cone around them";

inline constexpr Parameter tapered_capsule_parameters[] = {
    {.key = "radius", .count = 2, .offset = offsetof(TaperedCapsuleDesc, radius), .min = 0, .max = far_away,
     .min_excluded = true, .unit = "m", .what = "radius of the ball at -y and of the ball at +y"},
    {.key = "half_height", .offset = offsetof(TaperedCapsuleDesc, half_height), .min = 0, .max = far_away, .unit = "m",
     .what = "half the distance between the centers of the balls, along y"},
};

inline std::array<float, 4> shape_numbers(const TaperedCapsuleDesc& capsule) {
    const double difference = double{capsule.radius[0]} - double{capsule.radius[1]};
    const double length = 2 * double{capsule.half_height};
    // If one ball holds the other, there is no cone.
    const bool one_ball = !(std::abs(difference) < length);
    const double slope = one_ball ? (difference < 0 ? -1 : 1) : difference / length;
    return {capsule.radius[0], capsule.radius[1], capsule.half_height, static_cast<float>(slope)};
}

constexpr float shape_roundness(const TaperedCapsuleDesc& capsule) {
    return std::min(capsule.radius[0], capsule.radius[1]);
}

inline Bounds shape_bounds(const TaperedCapsuleDesc& capsule) {
    const float r = std::max(capsule.radius[0], capsule.radius[1]), y = capsule.half_height;
    const float low = std::min(-y - capsule.radius[0], y - capsule.radius[1]);
    const float high = std::max(y + capsule.radius[1], capsule.radius[0] - y);
    return {{-r, low, -r}, {r, high, r}};
}

}  // namespace weft
