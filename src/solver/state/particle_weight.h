// An inverse mass, as it changes while a cloth moves.
#pragma once

#include <cstdint>

namespace weft {

struct ParticleWeight {
    std::uint32_t particle = 0;
    float weight = 0;  ///< 1/kg; 0 for what is pinned
};

}  // namespace weft
