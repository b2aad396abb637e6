// Adhesion: a particle held to a point of a collider by a spring. Read by C++ and by GLSL.
#ifndef WEFT_ADHESION_DATA_H
#define WEFT_ADHESION_DATA_H

// The numbers of one row.
//   target_x … target_z  m    where the point of the collider is at the end of the substep
//   compliance           m/N  inverse stiffness of the spring; 0: rigid
#define WEFT_ROW_adhesion(FIELD) FIELD(target_x) FIELD(target_y) FIELD(target_z) FIELD(compliance)

#ifdef __cplusplus
#include "base/parameter.h"

#include <array>

namespace weft {

struct AdhesionMaterial {
    static constexpr int plain[2] = {-1, -1};
};

// A collider has the numbers.
inline constexpr std::array<Parameter, 0> adhesion_parameters{};

}  // namespace weft
#endif
#endif
