// A collider's shape for the contact kernels in double.
#pragma once

#include "physics/scalar.h"
#include "solver/world/collider.h"

namespace weft {

/// Refers to the data of the collider's shape.
inline reference::Solid solid_of(const Collider& collider) {
    const auto& n = collider.numbers;
    return {static_cast<int>(collider.shape),
            {double{n[0]}, double{n[1]}, double{n[2]}, double{n[3]}, blocks_of(collider)},
            double{steepness_of(collider)},
            double{roundness_of(collider)},
            double{width_of(collider)}};
}

}  // namespace weft
