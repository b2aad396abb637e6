// Tether: a particle no farther from where the cloth is held than the way over the cloth. Read by C++ and by GLSL.
#ifndef WEFT_TETHER_DATA_H
#define WEFT_TETHER_DATA_H

// The numbers of one row.
//   radius  m      largest distance, slack included
//   give    m²/N   so much more for every N/m of tension in the cloth
#define WEFT_ROW_tether(FIELD) FIELD(radius) FIELD(give)

#ifdef __cplusplus
#include "base/parameter.h"

#include <weft/scene.h>

#include <array>

namespace weft {

struct TetherMaterial {
    static constexpr int plain[2] = {-1, -1};

    Tethers use = Tethers::automatic;  ///< by itself, without a model that would choose, none
    float slack = 0;                   ///< of the rest distance
};

// A scene says this beside the fabric, of the cloth.
inline constexpr std::array<Parameter, 0> tether_parameters{};

}  // namespace weft
#endif
#endif
