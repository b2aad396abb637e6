// How taut a cloth is: coarse levels and tethers give way to its elasticity.
#pragma once

#include "scene/fabric.h"
#include "solver/model/constraint_table.h"

#include <span>

namespace weft {

/// N/m: what all but a twentieth of the rows stay below in the last substep. `lambda`: of the table's rows;
/// `substep_seconds`: 0 before the first step. Looks at every fourth vector of rows.
float tension_in(const ConstraintTable& stretch, std::span<const float> lambda, double substep_seconds,
                 const Fabric& fabric);

}  // namespace weft
