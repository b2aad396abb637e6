// The plan of one island: the passes of the world's plan in which it has work, and the barriers between them.
#pragma once

#include "solver/plan/barriers.h"
#include "solver/plan/world_plan.h"

#include <span>
#include <vector>

namespace weft {

struct IslandPass {
    Pass pass;
    bool barrier = true;  ///< all threads wait for one another before the pass
    bool single = false;  ///< one thread runs the pass, because it is too small to share
    bool all = false;     ///< all cloths of the island take part, so takes_part() need not be called
};

class IslandPlan {
  public:
    IslandPlan() = default;
    /// `links`: of the island.
    IslandPlan(const WorldPlan& plan, std::span<const PlannedCloth> cloths, std::span<const LinkTables* const> links,
               Sharing sharing = Sharing::fixed);

    std::span<const IslandPass> frame_begin() const { return frame_begin_; }
    std::span<const IslandPass> substep(std::uint32_t substep) const {
        return substep == 0 ? first_ : substep + 1 == substeps_ ? last_ : middle_;
    }
    std::span<const IslandPass> frame_end() const { return frame_end_; }

    /// Calls visit(island pass, substep) for all passes of a frame, in order.
    template <class Visit>
    void for_each_pass(Visit&& visit) const {
        for (const IslandPass& pass : frame_begin_) visit(pass, 0u);
        for (std::uint32_t s = 0; s < substeps_; ++s)
            for (const IslandPass& pass : substep(s)) visit(pass, s);
        for (const IslandPass& pass : frame_end_) visit(pass, substeps_ - 1);
    }

  private:
    std::uint32_t substeps_ = 0;
    std::vector<IslandPass> frame_begin_, first_, middle_, last_, frame_end_;
};

}  // namespace weft
