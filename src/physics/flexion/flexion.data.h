// Flexion: the distance between the tips of two triangles that share an edge. Read by C++ and by GLSL (flexion.md has
// the law).
#ifndef WEFT_FLEXION_DATA_H
#define WEFT_FLEXION_DATA_H

// The numbers of one row.
//   rest        m    distance of the tips at ease
//   compliance  m/N  inverse stiffness
#define WEFT_ROW_flexion(FIELD) FIELD(rest) FIELD(compliance)

#ifdef __cplusplus
#include "physics/bend/bend.data.h"
#include "base/parameter.h"

#include <array>

namespace weft {

/// What keeps tips apart is what hinges are made of: a fabric says it once, under the keys of bend.
using FlexionMaterial = BendMaterial;
inline constexpr std::array<Parameter, 0> flexion_parameters{};

}  // namespace weft
#endif
#endif
