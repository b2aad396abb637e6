// Residual of the stretch constraints: the error that the solver left, without the stretch due to compliance.
#pragma once

#include "solver/model/cloth_model.h"

#include <span>

namespace weft {

/// |C + α̃λ| / rest length over the stretch constraints.
struct Residual {
    double mean = 0, max = 0;
};

/// `lambda`: multipliers after the last substep. `substep_seconds`: its length in s; 0 to measure |C| only.
Residual stretch_residual(const ClothModel& model, std::span<const Vec4> positions, std::span<const float> lambda,
                          double substep_seconds);

}  // namespace weft
