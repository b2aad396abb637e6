// Where a cloth is held.
#pragma once

#include "physics/rest_shape.h"

#include <cstdint>
#include <vector>

namespace weft {

/// Held particles that hang together over edges between them: a corner, a hem, the tip of an ear.
std::vector<std::vector<std::uint32_t>> held_places(const RestShape& rest);

}  // namespace weft
