// Rows of stretch along lines through the mesh, which a step may solve a line at a time (stretch/line.md).
#pragma once

#include "solver/model/constraint_table.h"

#include <weft/vector.h>

#include <span>

namespace weft {

/// Rows per line at most: what a line keeps between elimination and substitution should stay in a near cache.
inline constexpr std::uint32_t longest_line = 64;

/// Every row in a line, if only in one of its own; lines of one batch share no particle. Rows that find no place in a
/// batch make the overflow. `positions`: of the particles, at rest.
ConstraintTable pack_lines(const RowList& stretch, std::span<const Vec3> positions, std::uint32_t particle_count,
                           const ColoringOptions& options = {});

}  // namespace weft
