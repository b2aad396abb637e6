// Tension in a cloth. Limits of coarse levels and tethers are extended by the stretch that it causes.
#pragma once

#include "scene/fabric.h"
#include "solver/model/constraint_table.h"

#include <span>

namespace weft {

/// Strain from which threads of both directions are straight (`stretch_limit`); very large if those of one never are.
float straight_strain(const StretchMaterial& material);

/// Tension in N/m that 95 % of the constraints did not exceed in the last substep. `lambda`: of the table;
/// `substep_seconds`: 0 before the first step. `material`: softest_stretch() of the model. Samples every fourth packet
/// of lane_padding rows.
float tension_in(const ConstraintTable& stretch, std::span<const float> lambda, double substep_seconds,
                 const StretchMaterial& material);

}  // namespace weft
