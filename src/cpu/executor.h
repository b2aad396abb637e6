// Executes one frame of one cloth: the plan's passes, spread over a worker team.
#pragma once

#include "base/workers.h"
#include "cpu/cloth_state.h"
#include "cpu/passes.h"
#include "solver/backend.h"

#include <array>
#include <vector>

namespace weft::cpu {

class Executor {
  public:
    Executor(const Passes& passes, WorkerTeam& team) : passes_(passes), team_(team), ranks_(team.ranks()) {}

    /// Returns Report bits. With report_non_finite the state is whatever came out.
    std::uint32_t run(ClothState& cloth, const StepPlan& plan, const StepInput& input,
                      std::array<double, stage_count>& stage_ms);

    /// Where the first non-finite value comes from: an input, or a pass of the frame that starts from the state as it
    /// is. Runs the frame once more on the calling thread, checking after each pass; leaves the state changed.
    std::string find_non_finite(ClothState& cloth, const StepPlan& plan, const StepInput& input);

  private:
    struct Frame;
    struct alignas(cache_line) Rank {
        std::uint32_t reports = 0;
    };

    void run_rank(const Frame& frame, unsigned rank, std::array<double, stage_count>& stage_ms);
    void run_pass(const Frame& frame, const Pass& pass, std::uint32_t substep, unsigned rank);
    void run_lines(const Frame& frame, const Pass& pass, std::uint32_t substep, unsigned rank);
    void run_rows(const Frame& frame, const Pass& pass, std::uint32_t substep, unsigned rank);
    void run_corrections(const Frame& frame, const Pass& pass, std::uint32_t substep, unsigned rank);
    Range level_range(std::uint32_t count, unsigned rank) const;
    void run_level(const Frame& frame, const Pass& pass, unsigned rank);
    void run_faces(const Frame& frame, const Pass& pass, unsigned rank);
    void run_holds(const Frame& frame, std::uint32_t substep, Share mine);
    void run_contacts(const Frame& frame, const Pass& pass, std::uint32_t substep, unsigned rank);
    void keep_last_good(const Frame& frame, unsigned rank);
    void check_finite(const Frame& frame, unsigned rank);
    static LambdaUse lambda_use(const Frame& frame, const Pass& pass, std::uint32_t substep);
    Frame make_frame(ClothState& cloth, const StepPlan& plan, const StepInput& input) const;

    const Passes& passes_;
    WorkerTeam& team_;
    std::vector<Rank> ranks_;
};

}  // namespace weft::cpu
