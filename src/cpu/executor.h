// Executes a frame: the plan's passes of every cloth, spread over a worker team.
#pragma once

#include "base/workers.h"
#include "cpu/cloth_state.h"
#include "cpu/passes.h"
#include "solver/world/backend.h"

#include <array>
#include <vector>

namespace weft::cpu {

class Executor {
  public:
    /// `smallest_shared`: as in CpuOptions.
    Executor(const Passes& passes, WorkerTeam& team, std::uint32_t smallest_shared = 0)
        : passes_(passes), team_(team), smallest_shared_(smallest_shared), ranks_(team.ranks()) {}

    struct Job {
        ClothState* cloth = nullptr;
        const StepPlan* plan = nullptr;
        const StepInput* input = nullptr;
        std::uint32_t reports = report_none;  ///< out. With report_non_finite the state is whatever came out.
    };

    /// Cloths too small to be worth the team's meetings have a thread each: of middling size if they are enough for all
    /// threads, the smallest always. Whatever does what: the bits are the same.
    void run(std::span<Job> jobs, std::array<double, stage_count>& stage_ms);

    /// Where the first non-finite value comes from: an input, or a pass of the frame that starts from the state as it
    /// is. Runs the frame once more on the calling thread, checking after each pass; leaves the state changed.
    std::string find_non_finite(ClothState& cloth, const StepPlan& plan, const StepInput& input);

  private:
    struct Frame;
    struct alignas(cache_line) Rank {
        std::uint32_t reports = 0;
        std::array<double, stage_count> stage_ms{};
    };

    void run_together(Job& job, std::span<Rank> ranks, std::array<double, stage_count>& stage_ms);
    void run_side_by_side(std::array<double, stage_count>& stage_ms);
    void run_rank(const Frame& frame, unsigned rank, std::array<double, stage_count>& stage_ms);
    void run_pass(const Frame& frame, const Pass& pass, std::uint32_t substep, unsigned rank);
    void run_lines(const Frame& frame, const Pass& pass, std::uint32_t substep, unsigned rank);
    void run_rows(const Frame& frame, const Pass& pass, std::uint32_t substep, unsigned rank);
    void run_corrections(const Frame& frame, const Pass& pass, std::uint32_t substep, unsigned rank);
    static Range level_range(const Frame& frame, std::uint32_t count, unsigned rank);
    /// The end of one substep and the beginning of the next.
    void run_advance(const Frame& frame, unsigned rank);
    void run_level(const Frame& frame, const Pass& pass, unsigned rank);
    void run_faces(const Frame& frame, const Pass& pass, unsigned rank);
    void run_holds(const Frame& frame, std::uint32_t substep, Share mine);
    void run_contacts(const Frame& frame, const Pass& pass, std::uint32_t substep, unsigned rank);
    void keep_last_good(const Frame& frame, unsigned rank);
    void check_finite(const Frame& frame, unsigned rank);
    void count_contacts(const Frame& frame, unsigned rank);
    static LambdaUse lambda_use(const Frame& frame, const Pass& pass, std::uint32_t substep);
    static Frame make_frame(const Job& job, std::span<Rank> ranks);

    const Passes& passes_;
    WorkerTeam& team_;
    std::uint32_t smallest_shared_;
    std::vector<Rank> ranks_;
    std::vector<Job*> small_;  // of the frame, the largest first
};

}  // namespace weft::cpu
