// What makes a collider a body.
#pragma once

#include "collide/body_features.h"
#include "physics/body/body_mass.h"

#include <weft/scene.h>

namespace weft {

struct Body {
    BodyMass mass;
    BodyDesc desc;  ///< its mass, density, center and inertia are those that `mass` was made from
};

}  // namespace weft
