// Capsule along the collider's y axis. Scene keys; the math is in capsule.kernel.h.
#pragma once

#include "physics/contact/shape.h"

namespace weft {

inline constexpr std::string_view capsule_what = "a segment of the collider's y axis with a radius";

inline constexpr Parameter capsule_parameters[] = {
    {.key = "radius", .offset = offsetof(CapsuleDesc, radius), .min = 0, .max = far_away, .min_excluded = true,
     .unit = "m", .what = "radius of its ends and its side"},
    {.key = "half_height", .offset = offsetof(CapsuleDesc, half_height), .min = 0, .max = far_away, .unit = "m",
     .what = "half the distance between the centers of its ends, along y"},
};

inline std::array<float, 4> shape_numbers(const CapsuleDesc& capsule) {
    return {capsule.radius, capsule.half_height, 0, 0};
}

inline Bounds shape_bounds(const CapsuleDesc& capsule) {
    const float r = capsule.radius, y = capsule.half_height + r;
    return {{-r, -y, -r}, {r, y, r}};
}

constexpr float shape_roundness(const CapsuleDesc& capsule) {
    return capsule.radius;
}

}  // namespace weft
