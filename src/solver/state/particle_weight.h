// A change of a particle's inverse mass.
#pragma once

#include <cstdint>

namespace weft {

struct ParticleWeight {
    std::uint32_t particle = 0;
    float weight = 0;  ///< inverse mass, 1/kg; 0: pinned
};

}  // namespace weft
