// Plate: the curvature of a triangle, from the angles across its edges. Read by C++ and by GLSL (law: plate.md).
#ifndef WEFT_PLATE_DATA_H
#define WEFT_PLATE_DATA_H

// The numbers of one constraint. Its energy is half the square of the transpose of L times the three angles.
//   rest_a … rest_c  rad      dihedral angle at rest across the edge opposite a, b and c; 0 is flat
//   l_aa … l_cc      √(N·m)   L, lower triangular; a row of zeros where an edge has no second triangle
#define WEFT_ROW_plate(FIELD) FIELD(rest_a) FIELD(rest_b) FIELD(rest_c) \
    FIELD(l_aa) FIELD(l_ba) FIELD(l_bb) FIELD(l_ca) FIELD(l_cb) FIELD(l_cc)

#ifdef __cplusplus
#include "physics/bend/bend.data.h"
#include "base/parameter.h"

#include <array>

namespace weft {

/// Has the same parameters as bend: a fabric gives them once, under the keys of bend.
using PlateMaterial = BendMaterial;
inline constexpr std::array<Parameter, 0> plate_parameters{};

}  // namespace weft
#endif
#endif
