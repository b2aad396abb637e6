// DistanceBend: the distance between the tips of two triangles that share an edge. Read by C++ and by GLSL (law:
// distance_bend.md).
#ifndef WEFT_DISTANCE_BEND_DATA_H
#define WEFT_DISTANCE_BEND_DATA_H

// The numbers of one constraint.
//   rest        m    distance of the tips at rest
//   compliance  m/N  inverse stiffness
#define WEFT_ROW_distance_bend(FIELD) FIELD(rest) FIELD(compliance)

#ifdef __cplusplus
#include "physics/bend/bend.data.h"
#include "base/parameter.h"

#include <array>

namespace weft {

/// Has the same parameters as bend: a fabric gives them once, under the keys of bend.
using DistanceBendMaterial = BendMaterial;
inline constexpr std::array<Parameter, 0> distance_bend_parameters{};

}  // namespace weft
#endif
#endif
