// Tether: limits the distance of a particle to a pin by the geodesic distance at rest. Read by C++ and by GLSL.
#ifndef WEFT_TETHER_DATA_H
#define WEFT_TETHER_DATA_H

// The numbers of one constraint.
//   radius      m     largest distance, slack included
//   compliance  m²/N  additional distance per N/m of tension in the cloth
#define WEFT_ROW_tether(FIELD) FIELD(radius) FIELD(compliance)

#ifdef __cplusplus
#include "base/parameter.h"

#include <weft/scene.h>

#include <array>

namespace weft {

struct TetherMaterial {
    static constexpr int plain[2] = {-1, -1};

    Tethers use = Tethers::automatic;  ///< used without a model, which would choose: none
    float slack = 0;                   ///< of the rest distance
};

// Scenes set these on the cloth, not on the fabric.
inline constexpr std::array<Parameter, 0> tether_parameters{};

}  // namespace weft
#endif
#endif
