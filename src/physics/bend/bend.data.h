// Bend: the dihedral angle across an edge. Read by C++ and by GLSL (law: bend.md).
#ifndef WEFT_BEND_DATA_H
#define WEFT_BEND_DATA_H

// The numbers of one constraint.
//   rest        rad      dihedral angle at rest; 0 is flat
//   compliance  1/(N·m)  (A₁ + A₂) / (B ℓ²)
#define WEFT_ROW_bend(FIELD) FIELD(rest) FIELD(compliance)

#ifdef __cplusplus
#include "base/parameter.h"

#include <limits>

namespace weft {

/// Which edges bend. `no_diagonals` leaves out the diagonals of flat rectangles.
enum class BendEdges { all, no_diagonals };

/// How curvature is measured: by the angle across each edge, with moments that act together in each triangle (moment.md),
/// or each alone (bend.md); by the three angles of a triangle together (plate.md); or by the distance between the tips of
/// two neighboring triangles (distance_bend.md).
enum class BendModel { moment, dihedral, plate, distance };

struct BendMaterial {
    static constexpr int plain[2] = {2, 2};

    float bend[3] = {11.9e-6f, 9.1e-6f, 6.6e-6f};                 ///< N·m: warp, bias, weft
    float rest_angle = std::numeric_limits<float>::quiet_NaN();  ///< degrees; NaN: as the mesh is built
    BendEdges edges = BendEdges::all;
    BendModel model = BendModel::moment;
};

inline constexpr Parameter bend_parameters[] = {
    {.key = "bend", .count = 3, .offset = offsetof(BendMaterial, bend), .min = 0, .max = 1e3, .unit = "N·m",
     .what = "bending stiffness per width for curvature along warp, bias and weft; 0: none"},
    {.key = "rest_angle", .kind = ParameterKind::angle_or_mesh, .offset = offsetof(BendMaterial, rest_angle),
     .min = -180, .max = 180, .unit = "°", .what = "dihedral angle at rest: \"mesh\": as in the mesh, or degrees"},
    {.key = "bend_edges", .kind = ParameterKind::choice, .offset = offsetof(BendMaterial, edges),
     .what = "`all` edges, or `no-diagonals`: all but the diagonals of flat rectangles; only for `dihedral` and `distance`",
     .choices = "all|no-diagonals",
     .choice_words = "bends at every edge|not at the diagonals of flat rectangles"},
    {.key = "bend_model", .kind = ParameterKind::choice, .offset = offsetof(BendMaterial, model),
     .what = "`moment`: the angle across each edge, with moments that act together in each triangle: bends as `bend` says on "
             "any mesh; `dihedral`: each edge alone, up to a fifth too soft or too stiff; `plate`: the curvature of each "
             "triangle; `distance`: springs between the tips of neighboring triangles, a fifth of the cost, too soft for "
             "slight folds",
     .choices = "moment|dihedral|plate|distance",
     .choice_words = "bends as the fabric says, on any mesh|each edge alone; up to a fifth off|"
                     "curvature of each triangle|springs between neighboring triangles; fast"},
};

}  // namespace weft
#endif
#endif
