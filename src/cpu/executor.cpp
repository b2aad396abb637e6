#include "cpu/executor.h"

#include "base/flush_subnormals.h"
#include "solver/measures/diagnosis.h"

#include <algorithm>
#include <atomic>
#include <chrono>

namespace weft::cpu {
namespace {

// Particles. Two threads that share a cotton sheet of 128² are 1.5 times as fast as one; with one such sheet each they
// are twice as fast.
constexpr std::uint32_t largest_small_island = 20000;

class StageClock {
  public:
    explicit StageClock(std::array<double, stage_count>& stage_ms) : stage_ms_(stage_ms), since_(now()) {}

    /// Call when a pass of `stage` begins.
    void enter(std::uint32_t stage) {
        if (stage == stage_) return;  // reading the clock costs 25 ns, a pass over a small cloth little more
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
    if (std::ranges::count_if(jobs, is_small) < static_cast<std::ptrdiff_t>(team_.size())) limit = smallest_shared_;
    small_.clear();
    for (Job& job : jobs) {
        if (is_small(job)) small_.push_back(&job);
        prepare(step, job, is_small(job) ? 1 : team_.size());
    }
    const bool side_by_side = team_.size() > 1 && small_.size() > 1;
    for (Job& job : jobs) {
        if (!is_small(job)) {
            run_together(step, job, team_.size(), stage_ms);
        } else if (!side_by_side) {
            run_together(step, job, 1, stage_ms);
        }
    }
    if (side_by_side) run_side_by_side(step, stage_ms);
}

// Runs on the calling thread only: an exception on another thread could not be caught.
void Executor::prepare(const WorldStep& step, Job& job, unsigned workers) {
    for (ClothState* cloth : job.cloths) {
        if (cloth->model->collision.surface) continue;
        cloth->prepare(*step.plan, step.input.colliders.size(), workers, step.input.contact_forces,
                       !step.input.bodies.empty());
    }
    if (!job.bodies) job.bodies = &no_bodies_;
    job.bodies->prepare(step, workers);
    for (const Job::Links& links : job.links) links.state->prepare(*links.tables, *step.plan);
    if (job.adhesion) job.adhesion->prepare({passes_, step, job.cloths});
    for (std::size_t i = 0; i < job.swept.size(); ++i)
        if (!job.cloths[i]->model->collision.surface) *job.swept[i] = {};
    const std::size_t particles = job.cloths.front()->world.size();
    if (job.cloth_contact) {
        contact_arrays_.reserve(particles, team_.size());
        job.cloth_contact->prepare(passes_, step, job.cloths, job.steps, job.step->seams, contact_arrays_, job.swept);
    }
    if (job.particle_contact) {
        particle_arrays_.reserve(particles, team_.size());
        job.particle_contact->prepare(passes_, {step, job.cloths, job.step->seams, particle_arrays_, job.swept},
                                      workers);
    }
    job.reports.assign(job.cloths.size(), report_none);
    for (WorkerScratch& scratch : scratch_) {
        if (scratch.reports.size() < job.cloths.size()) scratch.reports.resize(job.cloths.size());
        scratch.runs.reserve(job.cloths.size());
    }
}

void Executor::begin_island(const WorldStep& step, const Job& job, std::vector<ClothRun>& runs) const {
    runs.clear();
    for (std::size_t i = 0; i < job.cloths.size(); ++i) {
        // The limits follow from the state after the previous frame. A repeated frame keeps them, since its first run
        // has overwritten that state.
        if (!job.again) job.cloths[i]->begin_frame(*step.plan);
        runs.emplace_back(passes_, *job.cloths[i], *job.bodies, step, *job.steps[i]);
    }
}

void Executor::run_together(const WorldStep& step, Job& job, unsigned workers,
                            std::array<double, stage_count>& stage_ms) {
    begin_island(step, job, scratch_.front().runs);
    const Island island{step, job, scratch_.front().runs};
    if (workers == 1) {
        run_worker(island, {}, scratch_.front(), stage_ms);
    } else {
        team_.run([&](unsigned worker) {
            WorkerScratch& scratch = scratch_[worker];
            run_worker(island, {worker, workers}, scratch, worker == 0 ? stage_ms : scratch.stage_ms);
        });
    }
    for (std::size_t i = 0; i < job.cloths.size(); ++i) {
        job.cloths[i]->end_frame(*step.plan, step.input.dt);
        for (unsigned worker = 0; worker < workers; ++worker) job.reports[i] |= scratch_[worker].reports[i];
        if (!job.bodies->all_finite()) job.reports[i] |= report_non_finite;
    }
}

void Executor::run_side_by_side(const WorldStep& step, std::array<double, stage_count>& stage_ms) {
    std::ranges::sort(small_, [](const Job* a, const Job* b) {
        const std::uint32_t na = particles_in(*a), nb = particles_in(*b);
        return na != nb ? na > nb : a < b;
    });
    std::atomic<std::size_t> next = 0;
    team_.run([&](unsigned worker) {
        WorkerScratch& mine = scratch_[worker];
        mine.stage_ms.fill(0);
        for (std::size_t i = next.fetch_add(1); i < small_.size(); i = next.fetch_add(1)) {
            Job& job = *small_[i];
            begin_island(step, job, mine.runs);
            run_worker({step, job, mine.runs}, {}, mine, mine.stage_ms);
            for (std::size_t c = 0; c < job.cloths.size(); ++c) {
                job.cloths[c]->end_frame(*step.plan, step.input.dt);
                job.reports[c] = mine.reports[c];
            }
        }
    });
    for (const WorkerScratch& scratch : scratch_) {
        for (std::uint32_t stage = 0; stage < stage_count; ++stage)
            stage_ms[stage] += scratch.stage_ms[stage] / static_cast<double>(scratch_.size());
    }
}

void Executor::run_worker(const Island& island, Worker worker, WorkerScratch& scratch,
                          std::array<double, stage_count>& stage_ms) {
    const FlushSubnormals flush;
    std::array<double, stage_count> mine{};
    StageClock clock(mine);
    const std::span reports(scratch.reports.data(), island.runs.size());
    std::ranges::fill(reports, report_none);
    const auto barrier = [&] {
        if (worker.count > 1) team_.barrier();
    };
    for (const ClothRun& run : island.runs) run.keep_last_good(worker);
    island.job.step->plan->for_each_pass([&](const IslandPass& pass, std::uint32_t substep) {
        if (pass.barrier) barrier();
        clock.enter(stage_of(pass.pass));
        run_pass(island, pass, substep, worker, reports);
    });
    barrier();
    for (std::size_t i = 0; i < island.runs.size(); ++i) {
        if (!island.runs[i].all_finite(worker)) reports[i] |= report_non_finite;
        island.runs[i].count_contacts(worker);
    }
    clock.stop();
    if (worker.number == 0) {
        for (std::uint32_t stage = 0; stage < stage_count; ++stage) stage_ms[stage] += mine[stage];
    }
}

void Executor::run_pass(const Island& island, const IslandPass& pass, std::uint32_t substep, Worker worker,
                        std::span<std::uint32_t> reports) const {
    if (pass.pass.source == RowSource::links) {
        WorldArrays& world = island.job.cloths.front()->world;
        const float h = frame_numbers(island.runs.front().model(), *island.step.plan, island.step.input.dt).h;
        for (const Job::Links& links : island.job.links)
            links.state->run(passes_, *links.tables, *island.step.plan, pass.pass, substep,
                             world.range(0, world.size()).view(), h, worker);
        return;
    }
    if (is_body_pass(pass.pass.kind)) {
        if (worker.number == 0) island.job.bodies->run(pass.pass);
        return;
    }
    // The island's plan has the passes of all its cloths; those of the job may have no part in contact.
    if (is_cloth_contact(pass.pass.kind)) {
        if (!island.job.cloth_contact) return;
        return island.job.cloth_contact->run({island.step, island.job.cloths, [this] { team_.barrier(); }, substep},
                                             pass.pass, worker);
    }
    if (is_particle_contact(pass.pass.kind)) {
        if (island.job.particle_contact) island.job.particle_contact->run(pass.pass, worker);
        return;
    }
    if (pass.pass.source == RowSource::dynamic)
        return island.job.adhesion->run({passes_, island.step, island.job.cloths}, pass.pass, substep, worker);
    for (std::size_t i = 0; i < island.runs.size(); ++i) {
        if (island.runs[i].run(pass, substep, worker)) reports[i] |= report_speed_capped;
    }
}

std::string Executor::find_non_finite(const WorldStep& step, const Job& job) {
    const auto points = [](const ClothState& cloth, std::span<const Vec4> array) {
        return array.first(cloth.model->point_count());
    };
    for (std::size_t i = 0; i < job.cloths.size(); ++i) {
        const ClothState& cloth = *job.cloths[i];
        const Particles now = cloth.now();
        std::string culprit = name_input(step.input, job.steps[i]->motion_poses, points(cloth, now.position),
                                         points(cloth, now.velocity));
        if (!culprit.empty()) return culprit;
    }
    const FlushSubnormals flush;
    WorkerScratch& scratch = scratch_.front();
    job.bodies->prepare(step, 1);
    begin_island(step, job, scratch.runs);
    const Island island{step, job, scratch.runs};
    const std::span reports(scratch.reports.data(), scratch.runs.size());
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
