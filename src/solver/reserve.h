// How far a taut cloth stretches by its own elasticity: as much as coarse levels must let it.
#pragma once

#include "scene/fabric.h"
#include "solver/constraint_table.h"

#include <span>

namespace weft {

/// Strain that all but a twentieth of the rows stay below by the tension that the last substep left in them. `lambda`:
/// of the table's rows; `substep_seconds`: 0 before the first step. Looks at every fourth vector of rows.
float elastic_reserve(const ConstraintTable& stretch, std::span<const float> lambda, double substep_seconds,
                      const Fabric& fabric);

}  // namespace weft
