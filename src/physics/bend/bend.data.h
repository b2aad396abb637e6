// Bend: the dihedral angle across an edge. Read by C++ and by GLSL (bend.md has the law).
#ifndef WEFT_BEND_DATA_H
#define WEFT_BEND_DATA_H

// The numbers of one row.
//   rest        rad      dihedral angle at ease; 0 is flat
//   compliance  1/(N·m)  (A₁ + A₂) / (B ℓ²)
#define WEFT_ROW_bend(FIELD) FIELD(rest) FIELD(compliance)

#ifdef __cplusplus
#include "base/parameter.h"

#include <limits>

namespace weft {

/// Which hinges bend: `source` leaves out those that only cutting a rectangle in two has made.
enum class HingeChoice { all, source };

/// What measures the curvature: the angles across the edges one by one (bend.md), those of a triangle together
/// (plate.md), or how near to one another two triangles bring their tips (flexion.md).
enum class BendModel { hinges, plate, distance };

struct BendMaterial {
    static constexpr int plain[2] = {2, 2};

    float bend[3] = {11.9e-6f, 9.1e-6f, 6.6e-6f};                 ///< N·m: warp, bias, weft
    float rest_angle = std::numeric_limits<float>::quiet_NaN();  ///< degrees; NaN: as the mesh is built
    HingeChoice hinges = HingeChoice::all;
    BendModel model = BendModel::hinges;
};

inline constexpr Parameter bend_parameters[] = {
    {.key = "bend", .count = 3, .offset = offsetof(BendMaterial, bend), .min = 0, .max = 1e3, .unit = "N·m",
     .what = "bending stiffness per width for curvature along warp, bias and weft; 0 is limp"},
    {.key = "rest_angle", .kind = ParameterKind::angle_or_mesh, .offset = offsetof(BendMaterial, rest_angle),
     .min = -180, .max = 180, .unit = "°", .what = "dihedral angle at ease: \"mesh\" as the mesh is built, or degrees"},
    {.key = "hinges", .kind = ParameterKind::choice, .offset = offsetof(BendMaterial, hinges),
     .what = "`all` edges bend, or those of the `source`: not the diagonals of flat rectangles", .choices = "all|source"},
    {.key = "bend_model", .kind = ParameterKind::choice, .offset = offsetof(BendMaterial, model),
     .what = "`hinges` measure curvature edge by edge, a `plate` triangle by triangle: closer to `bend`, and twice the work; "
             "`distance` rows between the tips of neighboring triangles take a third of it, but let slight folds be",
     .choices = "hinges|plate|distance"},
};

}  // namespace weft
#endif
#endif
