// Groups of pinned particles.
#pragma once

#include "physics/rest_shape.h"

#include <cstdint>
#include <vector>

namespace weft {

/// Connected groups of pinned particles: a corner, a hem, the tip of an ear.
std::vector<std::vector<std::uint32_t>> pinned_places(const RestShape& rest);

}  // namespace weft
