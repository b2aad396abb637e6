// Averaged Jacobi: every constraint computes its corrections from the same positions, then each particle takes the mean
// of its corrections. Each constraint writes to its own elements, and a particle sums its list in a fixed order. The
// result is therefore the same for any number of threads, without atomics.
#pragma once

#include "solver/model/cloth_model.h"

#include <array>
#include <cstdint>
#include <vector>

namespace weft {

struct JacobiGather {
    /// The correction of particle `slot` of a constraint is block first[kind] + slot · stride + row.
    std::array<std::uint32_t, constraint_kind_count> first{};
    std::uint32_t blocks = 0;

    std::vector<std::uint32_t> offsets;  ///< blocks of particle p: items[offsets[p] … offsets[p + 1])
    std::vector<std::uint32_t> items;

    /// Per table row, padding included: 1 / n, where n is the largest number of constraints at one of its particles. If
    /// stiffness is in N/m, all particles of a constraint take this fraction of the correction. Its lambda then matches
    /// the applied correction, and momentum is conserved.
    std::array<AlignedVector<float>, constraint_kind_count> share;
};

JacobiGather build_gather(const ClothModel& model);

}  // namespace weft
