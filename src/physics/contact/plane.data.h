// Plane: everything below it is solid. Scene keys; the math is in plane.kernel.h.
#pragma once

#include "physics/contact/shape.h"

#include <cmath>

namespace weft {

inline constexpr std::string_view plane_what = "everything below a plane is solid";

inline constexpr Parameter plane_parameters[] = {
    {.key = "normal", .kind = ParameterKind::vector, .count = 3, .offset = offsetof(PlaneDesc, normal),
     .min = -far_away, .max = far_away, .what = "normal, pointing out of the solid; any length but 0"},
    {.key = "offset", .offset = offsetof(PlaneDesc, offset), .min = -far_away, .max = far_away, .unit = "m",
     .what = "distance of the plane from the collider's origin, along the normal"},
};

inline std::array<float, 4> shape_numbers(const PlaneDesc& plane) {
    const Vec3 n = normalized(plane.normal);
    return {n.x, n.y, n.z, plane.offset};
}

inline Bounds shape_bounds(const PlaneDesc&) {
    return everywhere;
}

inline ShapeProblem shape_problem(const PlaneDesc& plane) {
    // A shorter normal counts as zero.
    constexpr double min_normal_length = 1e-9;
    const double x = plane.normal.x, y = plane.normal.y, z = plane.normal.z;
    if (std::sqrt(x * x + y * y + z * z) < min_normal_length) return {"normal", "must not be zero"};
    return {};
}

constexpr float shape_roundness(const PlaneDesc&) {
    return std::numeric_limits<float>::infinity();
}

}  // namespace weft
