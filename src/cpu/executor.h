// Executes a frame: the passes of every island, spread over a worker team.
#pragma once

#include "base/workers.h"
#include "cpu/adhesion_list.h"
#include "cpu/cloth_run.h"
#include "cpu/links.h"

#include <array>
#include <string>
#include <vector>

namespace weft::cpu {

class Executor {
  public:
    /// `smallest_shared`: as in CpuOptions.
    Executor(const Passes& passes, WorkerTeam& team, std::uint32_t smallest_shared = 0)
        : passes_(passes), team_(team), smallest_shared_(smallest_shared), ranks_(team.ranks()) {}

    /// An island in a frame.
    struct Job {
        const IslandStep* step = nullptr;
        std::vector<ClothState*> cloths = {};     ///< as in the step
        LinkState* links = nullptr;               ///< where the step has some
        AdhesionList* adhesion = nullptr;         ///< where something sticks
        bool again = false;                       ///< a frame that has been run before, from the same state
        std::vector<std::uint32_t> reports = {};  ///< out: per cloth. With report_non_finite it is whatever came out
    };

    /// Islands too small to be worth the team's barriers have a thread each: of middling size if they are enough for
    /// all threads, the smallest always. Whatever does what: the bits are the same.
    void run(const WorldStep& step, std::span<Job> jobs, std::array<double, stage_count>& stage_ms);

    /// Where the first non-finite value in a cloth of an island comes from: an input, or a pass of the frame that
    /// starts from the state as it is. Runs the frame once more on the calling thread, checking after each pass; leaves
    /// the state changed.
    std::string find_non_finite(const WorldStep& step, const Job& job);

  private:
    struct alignas(cache_line) Worker {
        std::vector<std::uint32_t> reports;  ///< per cloth of the island that it works on
        std::vector<ClothRun> runs;          ///< on one thread alone; all threads together use those of the first
        std::array<double, stage_count> stage_ms{};
    };
    struct Island {
        const WorldStep& step;
        const Job& job;
        std::span<const ClothRun> runs;
    };

    void prepare(const WorldStep& step, Job& job, unsigned ranks);
    void begin_island(const WorldStep& step, const Job& job, std::vector<ClothRun>& runs) const;
    void run_together(const WorldStep& step, Job& job, unsigned ranks, std::array<double, stage_count>& stage_ms);
    void run_side_by_side(const WorldStep& step, std::array<double, stage_count>& stage_ms);
    void run_rank(const Island& island, Rank rank, Worker& worker, std::array<double, stage_count>& stage_ms);
    void run_pass(const Island& island, const IslandPass& pass, std::uint32_t substep, Rank rank,
                  std::span<std::uint32_t> reports) const;

    const Passes& passes_;
    WorkerTeam& team_;
    std::uint32_t smallest_shared_;
    std::vector<Worker> ranks_;
    std::vector<Job*> small_;  // of the frame, the largest first
};

}  // namespace weft::cpu
