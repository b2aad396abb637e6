// Stitches: the particles that a pair of points on cloth moves, and their shares.
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

/// Adds a stitch to the list. Leaves out particles with share 0; a particle of both points gets the difference of its
/// shares. If no particle is left, the two points are the same: adds nothing and returns false.
bool add_stitch(RowList& rows, const StitchPoint& a, const StitchPoint& b, float gap, float compliance);

}  // namespace weft
