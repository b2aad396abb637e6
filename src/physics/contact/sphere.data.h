// Sphere around the collider's origin. Scene keys; the math is in sphere.kernel.h.
#pragma once

#include "physics/contact/shape.h"

namespace weft {

inline constexpr std::string_view sphere_what = "a ball around the collider's origin";

inline constexpr Parameter sphere_parameters[] = {
    {.key = "radius", .offset = offsetof(SphereDesc, radius), .min = 0, .max = far_away, .min_excluded = true,
     .unit = "m", .what = "radius"},
};

inline std::array<float, 4> shape_numbers(const SphereDesc& sphere) {
    return {sphere.radius, 0, 0, 0};
}

inline Bounds shape_bounds(const SphereDesc& sphere) {
    const float r = sphere.radius;
    return {{-r, -r, -r}, {r, r, r}};
}

constexpr float shape_roundness(const SphereDesc& sphere) {
    return sphere.radius;
}

}  // namespace weft
