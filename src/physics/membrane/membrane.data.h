// Membrane: the part of a triangle's in-plane stiffness that its edges do not have. Read by C++ and by GLSL (law:
// membrane.md).
#ifndef WEFT_MEMBRANE_DATA_H
#define WEFT_MEMBRANE_DATA_H

// The numbers of one constraint. Its energy is half the square of the transpose of L times the three measures
// (length² - rest²)/2 of the edges.
//   rest_a … rest_c  m²          square of the length at rest of the edge opposite a, b and c
//   l_aa … l_cc      √(N/m)/m    L, lower triangular
#define WEFT_ROW_membrane(FIELD) FIELD(rest_a) FIELD(rest_b) FIELD(rest_c) \
    FIELD(l_aa) FIELD(l_ba) FIELD(l_bb) FIELD(l_ca) FIELD(l_cb) FIELD(l_cc)

#ifdef __cplusplus
#include "base/parameter.h"
#include "physics/stretch/stretch.data.h"

#include <array>

namespace weft {

/// Has the same parameters as stretch: a fabric gives them once, under the keys of stretch.
using MembraneMaterial = StretchMaterial;
inline constexpr std::array<Parameter, 0> membrane_parameters{};

}  // namespace weft
#endif
#endif
