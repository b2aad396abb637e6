// What makes a collider a body.
#pragma once

#include "collide/body_features.h"
#include "solver/state/body_state.h"

#include <weft/scene.h>

namespace weft {

struct Body {
    BodyMass mass;
    BodyState state;
    BodyDesc desc;  ///< its mass, density, center and inertia are those that `mass` was made from
};

}  // namespace weft
