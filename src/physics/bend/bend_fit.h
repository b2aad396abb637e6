// Factors for the stiffness of hinges with which a sheet in equilibrium bends as its fabric says (bend.md).
#pragma once

#include "physics/rest_shape.h"

namespace weft {

/// One factor per direction in which a hinge bends.
struct BendFit {
    float warp = 1, bias = 1, weft = 1;
    float at(float across) const { return directional(warp, bias, weft, across); }
};

/// Depends on the mesh alone. All 1 for a mesh that is too small or too curved to tell.
BendFit fit_bend(const RestShape& rest);

}  // namespace weft
