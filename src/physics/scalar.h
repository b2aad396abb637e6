// The kernels on one lane: `weft::scalar` in float, as the CPU backend's fallback and for single evaluations;
// `weft::reference` in double, for tests and measurements.
#pragma once

#include "physics/constraints.data.h"
#include "physics/contact/contact.data.h"
#include "physics/kernel_language.h"
#include "physics/shape_blocks.h"

#include <cmath>
#include <cstddef>
#include <cstdint>

namespace weft::scalar {
using real = float;
#include "physics/lanes_scalar.inl"

#include "physics/kernels.inl"
}  // namespace weft::scalar

namespace weft::reference {
using real = double;
#include "physics/lanes_scalar.inl"

#include "physics/kernels.inl"

inline vec3 to_double(Vec3 p) {
    return {p.x, p.y, p.z};
}
}  // namespace weft::reference
