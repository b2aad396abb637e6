// One cloth's part of a frame: what each pass does to it, share by share.
#pragma once

#include "base/workers.h"
#include "cpu/cloth_state.h"
#include "cpu/passes.h"
#include "solver/plan/frame_numbers.h"
#include "solver/plan/island_plan.h"
#include "solver/world/backend.h"

namespace weft::cpu {

/// Which part of a pass a thread does: the same part of the same items in every pass.
struct Rank {
    unsigned number = 0, count = 1;
    Share of(std::uint32_t items) const { return share_of(items, lane_padding, number, count); }
};

class ClothRun {
  public:
    ClothRun(const Passes& passes, ClothState& cloth, const WorldStep& step, const ClothStep& mine);

    const ClothModel& model() const { return *cloth_.model; }
    void keep_last_good(Rank rank) const;
    /// Returns whether the speed cap acted.
    bool run(const IslandPass& pass, std::uint32_t substep, Rank rank) const;
    bool all_finite(Rank rank) const;
    void count_contacts(Rank rank) const;

  private:
    Range particles(Rank rank) const;
    bool run_particles(const Pass& pass, std::uint32_t substep, Rank rank) const;
    void run_holds(std::uint32_t substep, Range mine) const;
    void run_contacts(const Pass& pass, std::uint32_t substep, Range mine) const;
    void run_rows(const Pass& pass, std::uint32_t substep, Rank rank) const;
    void run_lines(const Pass& pass, std::uint32_t substep, Rank rank) const;
    void run_corrections(const Pass& pass, std::uint32_t substep, Rank rank) const;
    void run_level(const IslandPass& island_pass, std::uint32_t substep, Rank rank) const;
    void run_faces(const Pass& pass, Rank rank) const;

    const Passes& passes_;
    ClothState& cloth_;
    const WorldPlan& plan_;
    const StepInput& input_;
    const ClothStep& step_;
    PlannedCloth planned_;
    ParticleView view_;
    FrameNumbers numbers_;
};

}  // namespace weft::cpu
