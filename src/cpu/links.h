// The constraints between the cloths of an island, as the CPU backend projects them.
#pragma once

#include "cpu/cloth_run.h"

#include <array>

namespace weft::cpu {

/// What a frame works with. Multipliers live for a substep alone.
class LinkState {
  public:
    /// Makes room; only here memory is asked for.
    void prepare(const LinkTables& tables, const WorldPlan& plan);
    void run(const Passes& passes, const LinkTables& tables, const WorldPlan& plan, const Pass& pass,
             std::uint32_t substep, const ParticleView& world, float h, Rank rank);

  private:
    std::array<AlignedVector<float>, constraint_kind_count> lambda_;
};

}  // namespace weft::cpu
