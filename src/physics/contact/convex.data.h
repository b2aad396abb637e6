// Convex hull of a mesh's vertices, rounded. Scene keys; the math is in convex.kernel.h, the hull in collide/.
#pragma once

#include "physics/contact/shape.h"

namespace weft {

inline constexpr std::string_view convex_what = "the convex hull of a mesh";

inline constexpr Parameter convex_parameters[] = {
    {.key = "file", .kind = ParameterKind::text, .offset = offsetof(ConvexDesc, file), .what = "name of a mesh file"},
    {.key = "scale", .offset = offsetof(ConvexDesc, scale), .min = 0, .max = far_away, .min_excluded = true,
     .unit = "m", .what = "length of the file's unit"},
    {.key = "up", .kind = ParameterKind::choice, .offset = offsetof(ConvexDesc, up),
     .what = "the file's axis that points up", .choices = "x|y|z"},
    {.key = "radius", .offset = offsetof(ConvexDesc, radius), .min = 0, .max = far_away, .unit = "m",
     .what = "everything within this distance of the hull is solid too"},
};

inline std::array<float, 4> shape_numbers(const ConvexDesc& convex) {
    return {convex.radius, 0, 0, 0};
}

inline Bounds shape_bounds(const ConvexDesc& convex) {
    const float r = convex.radius;
    return {{-r, -r, -r}, {r, r, r}};
}

constexpr float shape_roundness(const ConvexDesc& convex) {
    return convex.radius;
}

inline ShapeProblem shape_problem(const ConvexDesc& convex) {
    if (convex.file.empty() && convex.mesh.positions.empty()) return {"file", "must name a file"};
    return {};
}

}  // namespace weft
