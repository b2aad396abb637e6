// How much of its bending stiffness a cloth has in substeps of a length.
#pragma once

#include "solver/model/cloth_model.h"

#include <span>

namespace weft {

/// Part of the bending stiffness that is left at rest with one iteration per substep, at most 1: the mean over the
/// hinges of `dihedral` and `moment` bending, by their compliance, of the compliance over what it is after a sweep
/// (src/physics/sweep.md). 1 without hinges. Small on meshes that are fine for the substep. `substep_seconds` > 0.
double bending_share(const ClothModel& model, std::span<const Vec4> positions, double substep_seconds);

}  // namespace weft
