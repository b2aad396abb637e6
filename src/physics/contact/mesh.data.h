// A mesh as a solid. Scene keys; the math is in mesh.kernel.h, the distance field in collide/.
#pragma once

#include "physics/contact/shape.h"

namespace weft {

inline constexpr std::string_view mesh_what = "a mesh as a solid, by a distance field, or as a surface";

inline constexpr Parameter mesh_parameters[] = {
    {.key = "file", .kind = ParameterKind::text, .offset = offsetof(SolidMeshDesc, file),
     .what = "name of a mesh file"},
    {.key = "scale", .count = 3, .offset = offsetof(SolidMeshDesc, scale), .min = -far_away, .max = far_away, .unit = "m",
     .what = "length of the mesh's unit along its x, y and z axis; negative mirrors; not 0"},
    {.key = "up", .kind = ParameterKind::choice, .offset = offsetof(SolidMeshDesc, up),
     .what = "the file's axis that points up", .choices = "x|y|z"},
    {.key = "resolution", .kind = ParameterKind::integer, .offset = offsetof(SolidMeshDesc, resolution), .min = 4,
     .max = 1024, .what = "cells of the field along the longest side of the mesh"},
    {.key = "contact", .kind = ParameterKind::choice, .offset = offsetof(SolidMeshDesc, contact),
     .what = "what cloth with exact self-collision meets: the solid or, from either side, the triangles; `auto`: the "
             "triangles of a mesh with holes",
     .choices = "auto|solid|surface",
     .choice_words = "the triangles of a mesh with holes, else the solid|the inside is closed to cloth|"
                     "the triangles, from either side"},
};

inline std::array<float, 4> shape_numbers(const SolidMeshDesc&) {
    return {};
}

inline Bounds shape_bounds(const SolidMeshDesc&) {
    return {{}, {}};
}

inline ShapeProblem shape_problem(const SolidMeshDesc& solid) {
    if (solid.file.empty() && solid.mesh.positions.empty()) return {"file", "must name a file"};
    if (solid.scale.x == 0 || solid.scale.y == 0 || solid.scale.z == 0) return {"scale", "must not be 0"};
    return {};
}

}  // namespace weft
