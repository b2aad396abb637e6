// Executes a frame: runs the passes of all islands on a worker team.
#pragma once

#include "base/workers.h"
#include "cpu/adhesion_list.h"
#include "cpu/bodies.h"
#include "cpu/cloth_contact/cloth_contact.h"
#include "cpu/cloth_run.h"
#include "cpu/links.h"
#include "cpu/particle_contact/particle_contact.h"

#include <array>
#include <string>
#include <vector>

namespace weft::cpu {

class Executor {
  public:
    /// `smallest_shared`: as in CpuOptions.
    Executor(const Passes& passes, WorkerTeam& team, std::uint32_t smallest_shared = 0)
        : passes_(passes), team_(team), smallest_shared_(smallest_shared), scratch_(team.size()) {}

    /// Cloths of an island that step together in a frame: all, or the parts of a group (NearParts).
    struct Job {
        struct Links {
            const LinkTables* tables;
            LinkState* state;
        };
        const IslandStep* step = nullptr;
        std::vector<const ClothStep*> steps = {};  ///< by cloth
        std::vector<ClothState*> cloths = {};
        std::vector<Links> links = {};                ///< of the parts that have any
        std::vector<Bounds*> swept = {};              ///< by cloth: out; empty if that is not needed (NearParts)
        AdhesionList* adhesion = nullptr;             ///< null if nothing sticks
        ClothContact* cloth_contact = nullptr;        ///< null if no cloth collides exactly
        ParticleContact* particle_contact = nullptr;  ///< null if no cloth collides by particles
        Bodies* bodies = nullptr;                 ///< of the world; then the job has all cloths. Null: there are none
        bool again = false;                       ///< the frame is repeated from the same state
        std::vector<std::uint32_t> reports = {};  ///< out: per cloth; run() does not roll back non-finite ones
    };

    /// Runs islands that are too small to be worth the team's barriers on one thread each: those below
    /// `smallest_shared` always, those of medium size if there are enough of them for all threads. The bits do not
    /// depend on this.
    void run(const WorldStep& step, std::span<Job> jobs, std::array<double, stage_count>& stage_ms);

    /// Names the source of the first non-finite value in a cloth of an island: an input, or a pass of the frame that
    /// starts from the current state. Runs the frame again on the calling thread and checks after each pass; leaves the
    /// state changed.
    std::string find_non_finite(const WorldStep& step, const Job& job);

  private:
    struct alignas(cache_line) WorkerScratch {
        std::vector<std::uint32_t> reports;  ///< per cloth of the worker's current island
        std::vector<ClothRun> runs;          ///< a shared island uses those of worker 0
        std::array<double, stage_count> stage_ms{};
    };
    struct Island {
        const WorldStep& step;
        const Job& job;
        std::span<const ClothRun> runs;
    };

    void prepare(const WorldStep& step, Job& job, unsigned workers);
    void begin_island(const WorldStep& step, const Job& job, std::vector<ClothRun>& runs) const;
    void run_together(const WorldStep& step, Job& job, unsigned workers, std::array<double, stage_count>& stage_ms);
    void run_side_by_side(const WorldStep& step, std::array<double, stage_count>& stage_ms);
    void run_worker(const Island& island, Worker worker, WorkerScratch& scratch,
                    std::array<double, stage_count>& stage_ms);
    void run_pass(const Island& island, const IslandPass& pass, std::uint32_t substep, Worker worker,
                  std::span<std::uint32_t> reports) const;

    const Passes& passes_;
    WorkerTeam& team_;
    std::uint32_t smallest_shared_;
    std::vector<WorkerScratch> scratch_;
    std::vector<Job*> small_;  // of the frame, the largest first
    Bodies no_bodies_;
    ContactArrays contact_arrays_;
    ParticleArrays particle_arrays_;
};

}  // namespace weft::cpu
