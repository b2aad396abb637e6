// A body's values in a scene: keys, units and ranges, and the checks that ranges do not make.
#pragma once

#include "base/parameter.h"

#include <weft/scene.h>

#include <algorithm>
#include <cstddef>
#include <string_view>

namespace weft {

// clang-format off
inline constexpr Parameter rigid_body_parameters[] = {
    {.key = "mass", .offset = offsetof(BodyDesc, mass), .min = 0, .max = 1e9, .unit = "kg",
     .what = "mass; 0: the volume of the shape times `density`"},
    {.key = "density", .offset = offsetof(BodyDesc, density), .min = 0, .max = 1e6, .min_excluded = true, .unit = "kg/m³",
     .what = "density; without `mass`"},
    {.key = "center", .kind = ParameterKind::vector, .count = 3, .offset = offsetof(BodyDesc, center), .min = -far_away,
     .max = far_away, .unit = "m", .what = "center of mass, from where the shape has it, along the axes of the collider"},
    {.key = "inertia", .kind = ParameterKind::vector, .count = 3, .offset = offsetof(BodyDesc, inertia), .min = 0,
     .max = 1e15, .unit = "kg·m²",
     .what = "moments of inertia about the center of mass, along the axes of the collider; all 0: those of the shape"},
    {.key = "velocity", .kind = ParameterKind::vector, .count = 3, .offset = offsetof(BodyDesc, velocity), .min = -1e4,
     .max = 1e4, .unit = "m/s", .what = "velocity of the center of mass at the start"},
    {.key = "spin", .kind = ParameterKind::vector, .count = 3, .offset = offsetof(BodyDesc, spin), .min = -1e6, .max = 1e6,
     .unit = "°/s", .what = "angular velocity at the start, about the world's axes; 360 is one turn a second"},
    {.key = "damping", .offset = offsetof(BodyDesc, damping), .min = 0, .max = 1e6, .unit = "1/s",
     .what = "rate at which the velocity decays"},
    {.key = "spin_damping", .offset = offsetof(BodyDesc, spin_damping), .min = 0, .max = 1e6, .unit = "1/s",
     .what = "rate at which the spin decays"},
    {.key = "restitution", .offset = offsetof(BodyDesc, restitution), .min = 0, .max = 1,
     .what = "part of the speed at which it bounces off colliders and other bodies; a pair has the larger one"},
    {.key = "reaction", .kind = ParameterKind::flag, .offset = offsetof(BodyDesc, reaction),
     .what = "whether cloth pushes it; `false`: cloth meets it, and it does not feel the cloth"},
};
// clang-format on

/// What is wrong with moments of inertia within their range; empty: nothing.
inline std::string_view inertia_problem(Vec3 moments) {
    if (moments == Vec3{}) return {};
    if (!(moments.x > 0 && moments.y > 0 && moments.z > 0)) return "must hold three moments > 0 kg·m², or all 0";
    const double largest = std::max({moments.x, moments.y, moments.z});
    const double others = double{moments.x} + moments.y + moments.z - largest;
    if (largest > others * (1 + 1e-5))
        return "must hold moments that a body can have: each at most the sum of the other two";
    return {};
}

}  // namespace weft
