// Stretch: the distance along an edge. Read by C++ and by GLSL (law: stretch.md).
#ifndef WEFT_STRETCH_DATA_H
#define WEFT_STRETCH_DATA_H

// The numbers of one constraint.
//   rest         m    length at which the edge is at rest
//   compliance   m/N  inverse stiffness while the edge is longer than that
//   compression  m/N  inverse stiffness while it is shorter
//   play         m    how much longer than at rest it is when its threads are straight (stretch.md)
#define WEFT_ROW_stretch(FIELD) FIELD(rest) FIELD(compliance) FIELD(compression) FIELD(play)

#define WEFT_STRAIGHT_STIFFNESS 50.0  // of an edge whose threads are straight, over that at rest
#define WEFT_NEVER_STRAIGHT 1e15      // m, or strain: the threads never are

#ifdef __cplusplus
#include "base/parameter.h"

namespace weft {

/// What resists stretching: springs along the edges (stretch.md), or springs along the edges and the rest of each
/// triangle's stiffness (membrane.md).
enum class StretchModel { edges, membrane };

struct StretchMaterial {
    static constexpr int plain[2] = {0, 1};

    float stretch[2] = {4000, 4000};      ///< N/m, warp and weft
    float compression[2] = {4000, 4000};  ///< N/m, warp and weft
    float shear = 40;                     ///< N/m
    float stretch_limit[2] = {0, 0};      ///< strain along warp and weft at which threads are straight; 0: none
    bool inextensible = false;            ///< every edge keeps its length: all compliances 0
    StretchModel model = StretchModel::edges;
};

inline constexpr Parameter stretch_parameters[] = {
    {.key = "stretch", .count = 2, .offset = offsetof(StretchMaterial, stretch), .min = 0, .max = 1e9, .unit = "N/m",
     .what = "tensile stiffness along warp and weft; 0: none"},
    {.key = "compression", .count = 2, .offset = offsetof(StretchMaterial, compression), .min = 0, .max = 1e9,
     .unit = "N/m", .what = "compressive stiffness along warp and weft"},
    {.key = "shear", .count = 1, .offset = offsetof(StretchMaterial, shear), .min = 0, .max = 1e9, .unit = "N/m",
     .what = "shear stiffness"},
    {.key = "stretch_limit", .count = 2, .offset = offsetof(StretchMaterial, stretch_limit), .min = 0, .max = 10,
     .what = "strain along warp and weft at which the threads are straight: from half of it to one and a half times it the "
             "stiffness grows to 50 times; 0: none"},
    {.key = "inextensible", .kind = ParameterKind::flag, .offset = offsetof(StretchMaterial, inextensible),
     .what = "keep the length of every edge, whatever the stiffnesses"},
    {.key = "stretch_model", .kind = ParameterKind::choice, .offset = offsetof(StretchMaterial, model),
     .what = "`edges`: springs along the edges, exact for pulls along warp and weft on grids; `membrane`: exact strain of "
             "each triangle, on any mesh and in any direction",
     .choices = "edges|membrane",
     .choice_words = "springs along the edges|strain of each triangle"},
};

}  // namespace weft
#endif
#endif
