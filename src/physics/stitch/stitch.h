// Stitches: which particles a pair of points on cloth moves, and by what shares.
#pragma once

#include "physics/constraint.h"

#include <array>
#include <cstdint>

namespace weft {

/// A point on cloth: up to three particles and their shares, which sum to 1.
struct StitchPoint {
    std::array<std::uint32_t, 3> particles{};
    std::array<float, 3> shares{1, 0, 0};
};

/// Adds a stitch to a list of them. Particles without a share are left out; one that both points share is moved by the
/// difference. Adds nothing, and says false, where no particle is left: the two are one point.
bool add_stitch(RowList& rows, const StitchPoint& a, const StitchPoint& b, float gap, float compliance);

}  // namespace weft
