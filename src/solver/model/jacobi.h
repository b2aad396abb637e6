// Averaged Jacobi: every row computes its corrections from the same positions; then each particle takes the mean of
// what its rows want of it. Rows write to places of their own, and a particle sums its list in a fixed order, so the
// result is the same for any number of threads, and nothing needs an atomic.
#pragma once

#include "solver/model/cloth_model.h"

#include <array>
#include <cstdint>
#include <vector>

namespace weft {

struct JacobiGather {
    /// A row's correction of its particle `slot` is block first[kind] + slot · stride + row.
    std::array<std::uint32_t, constraint_kind_count> first{};
    std::uint32_t blocks = 0;

    std::vector<std::uint32_t> offsets;  ///< blocks of particle p: items[offsets[p] … offsets[p + 1])
    std::vector<std::uint32_t> items;

    /// Per row with padding: 1 over the larger number of rows at its particles. Where stiffness is in N/m, a row as a
    /// whole takes this part of its correction: all its particles the same part, so that lambda tells what it did, and
    /// momentum is kept.
    std::array<AlignedVector<float>, constraint_kind_count> share;
};

JacobiGather build_gather(const ClothModel& model);

}  // namespace weft
