// Moment: the dihedral angle across an edge, by moments that act together in each triangle. Read by C++ and by GLSL
// (law: moment.md).
#ifndef WEFT_MOMENT_DATA_H
#define WEFT_MOMENT_DATA_H

// The numbers of one constraint. The triangle with c, then that with d.
//   rest          rad      dihedral angle at rest; 0 is flat
//   compliance_c  1/(N·m)  what the triangle gives at once
//   compliance_d  1/(N·m)
//   total         1/(N·m)  of both, with what they give by the shift
#define WEFT_ROW_moment(FIELD) FIELD(rest) FIELD(compliance_c) FIELD(compliance_d) FIELD(total)

#ifdef __cplusplus
#include "physics/bend/bend.data.h"
#include "base/parameter.h"

#include <array>

namespace weft {

/// Has the same parameters as bend: a fabric gives them once, under the keys of bend.
using MomentMaterial = BendMaterial;
inline constexpr std::array<Parameter, 0> moment_parameters{};

}  // namespace weft
#endif
#endif
