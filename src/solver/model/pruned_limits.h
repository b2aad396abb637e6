// Coarse levels of a cloth in the frames in which it tears. Building them again takes as long as a frame, so they are
// pruned at first.
#pragma once

#include "solver/model/cloth_edit.h"
#include "solver/model/cloth_model.h"

#include <span>
#include <vector>

namespace weft {

/// What has opened since the coarse levels were built.
struct PrunedLevels {
    std::vector<std::uint32_t> vertices;  ///< of the mesh, at which edges have opened; ascending
};

/// Tethers cannot be pruned.
bool can_prune_limits(const ClothModel& model);

/// Removes the coarse limits that bound a distance by a path over the cloth which may cross an opening. Copies of
/// particles move with the nodes of the coarse levels that move their originals. The levels keep their sizes.
/// `first_copy`: the first particle that the openings have appended. The result depends on the levels as they were
/// built and on all openings since, in any number of calls.
void prune_limits(ClothModel& model, std::span<const Opening> openings, std::uint32_t first_copy);

}  // namespace weft
