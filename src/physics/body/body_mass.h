// Mass and moments of inertia of a rigid body.
#pragma once

#include <weft/vector.h>

#include <array>

namespace weft {

struct BodyMass {
    float mass = 1;  ///< kg
    Vec3 center;     ///< m: the center of mass, in the body's frame
    /// kg·m², about the center of mass, along the axes of the body's frame: xx, yy, zz, yz, zx, xy. The last three are
    /// the elements of the tensor, so they are negative sums of products.
    std::array<float, 6> inertia{1, 1, 1, 0, 0, 0};
    std::array<float, 6> inverse_inertia{1, 1, 1, 0, 0, 0};  ///< of its inverse, likewise
    friend bool operator==(const BodyMass&, const BodyMass&) = default;
};

}  // namespace weft
