// Stretch constraints ordered along lines through the mesh, so that a step can solve a whole line at once
// (stretch/line.md).
#pragma once

#include "solver/model/constraint_table.h"

#include <weft/vector.h>

#include <span>

namespace weft {

/// Largest number of constraints per line. The values that a line keeps between elimination and substitution should
/// fit in a near cache.
inline constexpr std::uint32_t longest_line = 64;

/// Puts every constraint into a line of one or more constraints. Lines of one batch share no particle. Constraints that
/// fit into no batch form the overflow. `positions`: m, of the particles at rest.
ConstraintTable pack_lines(const RowList& stretch, std::span<const Vec3> positions, std::uint32_t particle_count,
                           const ColoringOptions& options = {});

}  // namespace weft
