#include "cpu/executor.h"

#include "base/flush_subnormals.h"
#include "solver/measures/diagnosis.h"

#include <algorithm>
#include <atomic>
#include <chrono>

namespace weft::cpu {
namespace {

// Particles. Two threads take a cotton sheet of 128² 1.5 times as fast as one, two such sheets twice as fast.
constexpr std::uint32_t largest_small_island = 20000;

class StageClock {
  public:
    explicit StageClock(std::array<double, stage_count>& stage_ms) : stage_ms_(stage_ms), since_(now()) {}

    /// Call when a pass of `stage` begins.
    void enter(std::uint32_t stage) {
        if (stage == stage_) return;  // a reading costs 25 ns, a pass of a small cloth little more
        stop();
        stage_ = stage;
    }
    void stop() {
        const auto t = now();
        if (stage_ < stage_count) stage_ms_[stage_] += std::chrono::duration<double, std::milli>(t - since_).count();
        since_ = t;
    }

  private:
    static std::chrono::steady_clock::time_point now() { return std::chrono::steady_clock::now(); }

    std::array<double, stage_count>& stage_ms_;
    std::uint32_t stage_ = stage_count;
    std::chrono::steady_clock::time_point since_;
};

std::uint32_t particles_in(const Executor::Job& job) {
    std::uint32_t count = 0;
    for (const ClothState* cloth : job.cloths) count += cloth->model->particle_count;
    return count;
}

}  // namespace

void Executor::run(const WorldStep& step, std::span<Job> jobs, std::array<double, stage_count>& stage_ms) {
    std::uint32_t limit = largest_small_island + 1;
    const auto is_small = [&](const Job& job) { return particles_in(job) < limit; };
    if (std::ranges::count_if(jobs, is_small) < static_cast<std::ptrdiff_t>(team_.ranks())) limit = smallest_shared_;
    small_.clear();
    for (Job& job : jobs) {
        if (is_small(job)) small_.push_back(&job);
        prepare(step, job, is_small(job) ? 1 : team_.ranks());
    }
    const bool side_by_side = team_.ranks() > 1 && small_.size() > 1;
    for (Job& job : jobs) {
        if (!is_small(job)) {
            run_together(step, job, team_.ranks(), stage_ms);
        } else if (!side_by_side) {
            run_together(step, job, 1, stage_ms);
        }
    }
    if (side_by_side) run_side_by_side(step, stage_ms);
}

// On the calling thread alone: an exception on another one could not be caught.
void Executor::prepare(const WorldStep& step, Job& job, unsigned ranks) {
    for (ClothState* cloth : job.cloths)
        cloth->prepare(*step.plan, step.input.colliders.size(), ranks, step.input.feedback);
    if (job.links) job.links->prepare(*job.step->links, *step.plan);
    if (job.adhesion) job.adhesion->prepare({passes_, step, job.cloths});
    job.reports.assign(job.cloths.size(), report_none);
    for (Worker& worker : ranks_) {
        if (worker.reports.size() < job.cloths.size()) worker.reports.resize(job.cloths.size());
        worker.runs.reserve(job.cloths.size());
    }
}

void Executor::begin_island(const WorldStep& step, const Job& job, std::vector<ClothRun>& runs) const {
    runs.clear();
    for (std::size_t i = 0; i < job.cloths.size(); ++i) {
        // What limits allow for is found from what the frame before left, which the first run has written over.
        if (!job.again) job.cloths[i]->begin_frame(*step.plan);
        runs.emplace_back(passes_, *job.cloths[i], step, job.step->cloths[i]);
    }
}

void Executor::run_together(const WorldStep& step, Job& job, unsigned ranks,
                            std::array<double, stage_count>& stage_ms) {
    begin_island(step, job, ranks_.front().runs);
    const Island island{step, job, ranks_.front().runs};
    if (ranks == 1) {
        run_rank(island, {}, ranks_.front(), stage_ms);
    } else {
        team_.run([&](unsigned rank) {
            Worker& worker = ranks_[rank];
            run_rank(island, {rank, ranks}, worker, rank == 0 ? stage_ms : worker.stage_ms);
        });
    }
    for (std::size_t i = 0; i < job.cloths.size(); ++i) {
        job.cloths[i]->end_frame(*step.plan, step.input.dt);
        for (unsigned rank = 0; rank < ranks; ++rank) job.reports[i] |= ranks_[rank].reports[i];
    }
}

void Executor::run_side_by_side(const WorldStep& step, std::array<double, stage_count>& stage_ms) {
    std::ranges::sort(small_, [](const Job* a, const Job* b) {
        const std::uint32_t na = particles_in(*a), nb = particles_in(*b);
        return na != nb ? na > nb : a < b;
    });
    std::atomic<std::size_t> next = 0;
    team_.run([&](unsigned rank) {
        Worker& mine = ranks_[rank];
        mine.stage_ms.fill(0);
        for (std::size_t i = next.fetch_add(1); i < small_.size(); i = next.fetch_add(1)) {
            Job& job = *small_[i];
            begin_island(step, job, mine.runs);
            run_rank({step, job, mine.runs}, {}, mine, mine.stage_ms);
            for (std::size_t c = 0; c < job.cloths.size(); ++c) {
                job.cloths[c]->end_frame(*step.plan, step.input.dt);
                job.reports[c] = mine.reports[c];
            }
        }
    });
    for (const Worker& worker : ranks_) {
        for (std::uint32_t stage = 0; stage < stage_count; ++stage)
            stage_ms[stage] += worker.stage_ms[stage] / static_cast<double>(ranks_.size());
    }
}

void Executor::run_rank(const Island& island, Rank rank, Worker& worker, std::array<double, stage_count>& stage_ms) {
    const FlushSubnormals flush;
    std::array<double, stage_count> mine{};
    StageClock clock(mine);
    const std::span reports(worker.reports.data(), island.runs.size());
    std::ranges::fill(reports, report_none);
    const auto barrier = [&] {
        if (rank.count > 1) team_.meet();
    };
    for (const ClothRun& run : island.runs) run.keep_last_good(rank);
    island.job.step->plan->for_each_pass([&](const IslandPass& pass, std::uint32_t substep) {
        if (pass.barrier) barrier();
        clock.enter(stage_of(pass.pass));
        run_pass(island, pass, substep, rank, reports);
    });
    barrier();
    for (std::size_t i = 0; i < island.runs.size(); ++i) {
        if (!island.runs[i].all_finite(rank)) reports[i] |= report_non_finite;
        island.runs[i].count_contacts(rank);
    }
    clock.stop();
    if (rank.number == 0) {
        for (std::uint32_t stage = 0; stage < stage_count; ++stage) stage_ms[stage] += mine[stage];
    }
}

void Executor::run_pass(const Island& island, const IslandPass& pass, std::uint32_t substep, Rank rank,
                        std::span<std::uint32_t> reports) const {
    if (pass.pass.source == RowSource::links) {
        WorldArrays& world = island.job.cloths.front()->world;
        const float h = frame_numbers(island.runs.front().model(), *island.step.plan, island.step.input.dt).h;
        island.job.links->run(passes_, *island.job.step->links, *island.step.plan, pass.pass, substep,
                              world.range(0, world.size()).view(), h, rank);
        return;
    }
    if (pass.pass.source == RowSource::dynamic)
        return island.job.adhesion->run({passes_, island.step, island.job.cloths}, pass.pass, substep, rank);
    for (std::size_t i = 0; i < island.runs.size(); ++i) {
        if (island.runs[i].run(pass, substep, rank)) reports[i] |= report_speed_capped;
    }
}

std::string Executor::find_non_finite(const WorldStep& step, const Job& job) {
    const auto points = [](const ClothState& cloth, std::span<const Vec4> array) {
        return array.first(cloth.model->point_count());
    };
    for (std::size_t i = 0; i < job.cloths.size(); ++i) {
        const ClothState& cloth = *job.cloths[i];
        const Particles now = cloth.now();
        std::string culprit = name_input(step.input, job.step->cloths[i].mover_poses, points(cloth, now.position),
                                         points(cloth, now.velocity));
        if (!culprit.empty()) return culprit;
    }
    const FlushSubnormals flush;
    Worker& worker = ranks_.front();
    begin_island(step, job, worker.runs);
    const Island island{step, job, worker.runs};
    const std::span reports(worker.reports.data(), worker.runs.size());
    for (const Pass& pass : step.plan->frame_begin) run_pass(island, {pass}, 0, {}, reports);
    for (std::uint32_t substep = 0; substep < step.plan->substeps; ++substep) {
        for (const Pass& pass : step.plan->substep) {
            run_pass(island, {pass}, substep, {}, reports);
            for (const ClothState* cloth : job.cloths) {
                const Particles now = cloth->now();
                const std::uint32_t p = first_non_finite(points(*cloth, now.position), points(*cloth, now.velocity));
                if (p != none) return name_pass(*cloth->model, pass, substep, p);
            }
        }
    }
    return std::string(late_non_finite);
}

}  // namespace weft::cpu
