// What the solver left of stretch, the material set aside.
#pragma once

#include "solver/model/cloth_model.h"

#include <span>

namespace weft {

/// |C + α̃λ| / rest length over the rows.
struct Residual {
    double mean = 0, max = 0;
};

/// `lambda` as the last substep left it; `substep_seconds` its length, 0 where nothing but C counts.
Residual stretch_residual(const ClothModel& model, std::span<const Vec4> positions, std::span<const float> lambda,
                          double substep_seconds);

}  // namespace weft
