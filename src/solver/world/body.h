// What makes a collider a body.
#pragma once

#include "collide/body_features.h"
#include "solver/state/body_state.h"

#include <weft/scene.h>

namespace weft {

struct Body {
    BodyMass mass;  ///< with the particles of cloth that are pinned to it
    BodyState state;
    BodyDesc desc;        ///< its mass, density, center and inertia are those that `own` was made from
    BodyMass own = mass;  ///< without them
};

}  // namespace weft
