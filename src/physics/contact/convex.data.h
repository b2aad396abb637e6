// Convex hull of a mesh's vertices, rounded. Scene keys; the math is in convex.kernel.h, the hull in collide/.
#pragma once

#include "physics/contact/shape.h"

namespace weft {

inline constexpr std::string_view convex_what = "the convex hull of a mesh or of points";

inline constexpr Parameter convex_parameters[] = {
    {.key = "file", .kind = ParameterKind::text, .offset = offsetof(ConvexDesc, file), .what = "name of a mesh file"},
    {.key = "points", .kind = ParameterKind::list, .what = "points of 3 numbers, at least four, in place of `file`"},
    {.key = "scale", .count = 3, .offset = offsetof(ConvexDesc, scale), .min = -far_away, .max = far_away, .unit = "m",
     .what = "length of the mesh's unit along its x, y and z axis; negative mirrors; not 0"},
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
    if (convex.file.empty() && convex.mesh.positions.empty()) return {"file", "must name a file, unless there are `points`"};
    if (convex.scale.x == 0 || convex.scale.y == 0 || convex.scale.z == 0) return {"scale", "must not be 0"};
    return {};
}

}  // namespace weft
