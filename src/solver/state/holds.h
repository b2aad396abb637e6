// Particles whose place is given from outside: pins that move by keys, and pins that follow a collider.
#pragma once

#include "mesh/triangle_mesh.h"
#include "scene/scene_desc.h"

#include <weft/ids.h>

#include <cstdint>
#include <vector>

namespace weft {

/// What carries held particles along.
struct Mover {
    ColliderId collider = {};             ///< of the world, or none:
    std::vector<OffsetKey> offsets = {};  ///< then these, by ascending time
};

struct HeldParticle {
    std::uint32_t particle = 0;  ///< or an anchor, which is numbered behind the particles
    std::uint32_t mover = 0;
    Vec3 local = {};  ///< m, in the mover's frame: at rest for offsets, the collider's own for a collider
};

/// Of one cloth. Its particles have no weight in the model; those not named here stay where they start.
struct Holds {
    std::vector<Mover> movers;
    std::vector<HeldParticle> particles;  ///< by ascending particle, each once
};

}  // namespace weft
