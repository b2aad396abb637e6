// What a fabric makes of a hinge: the same for all that bends edge by edge.
#pragma once

#include "physics/bend/bend.data.h"
#include "physics/rest_shape.h"

#include <optional>

namespace weft {

struct HingeAtRest {
    float angle = 0;       ///< rad, dihedral, at ease; 0 is flat
    float compliance = 0;  ///< 1/(N·m): (A₁ + A₂) / (B ℓ²)
};

/// None for what does not bend, or is no hinge of the material's choice.
std::optional<HingeAtRest> hinge_at_rest(const RestShape& rest, const Hinge& hinge, const BendMaterial& material);

}  // namespace weft
