// Coarse levels and tethers of a cloth whose triangles have changed.
#pragma once

#include "solver/model/cloth_model.h"

namespace weft {

/// Rebuilds coarse levels, spans of pins and tethers from the model's triangles, if it has any: each piece of cloth
/// gets its own.
void rebuild_limits(ClothModel& model);
/// The same on a copy.
std::shared_ptr<const ClothModel> with_rebuilt_limits(const ClothModel& model);

}  // namespace weft
