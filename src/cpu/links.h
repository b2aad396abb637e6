// Projects the constraints between the cloths of an island on the CPU.
#pragma once

#include "cpu/cloth_run.h"

#include <array>

namespace weft::cpu {

/// Working memory of a frame. Multipliers are valid within a substep only.
class LinkState {
  public:
    /// Allocates; run() does not.
    void prepare(const LinkTables& tables, const WorldPlan& plan);
    void run(const Passes& passes, const LinkTables& tables, const WorldPlan& plan, const Pass& pass,
             std::uint32_t substep, const ParticleView& world, float h, Worker worker);

  private:
    std::array<AlignedVector<float>, constraint_kind_count> lambda_;
};

}  // namespace weft::cpu
