#include "cpu/executor.h"

#include "base/flush_subnormals.h"
#include "solver/measures/diagnosis.h"
#include "solver/plan/frame_numbers.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstring>

namespace weft::cpu {
namespace {

// Particles. Two threads take a cotton sheet of 128² 1.5 times as fast as one, two such sheets twice as fast.
constexpr std::uint32_t largest_small_cloth = 20000;

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

// Whole blocks, as nearly as can be as many rows for every rank.
std::span<const LineBlock> share_of_blocks(const ConstraintTable& table, const Batch& batch, unsigned rank,
                                           unsigned ranks) {
    const auto blocks = std::span(table.blocks).subspan(batch.first_block, batch.blocks);
    const auto bound = [&](unsigned r) {
        const std::uint64_t row = batch.begin + std::uint64_t{batch.rows} * r / ranks;
        const auto middle = [](const LineBlock& block) { return block.begin + block.length * lane_padding / 2; };
        return std::ranges::lower_bound(blocks, row, {}, middle) - blocks.begin();
    };
    const auto begin = static_cast<std::size_t>(bound(rank)), end = static_cast<std::size_t>(bound(rank + 1));
    return blocks.subspan(begin, end - begin);
}

}  // namespace

struct Executor::Frame {
    ClothState& cloth;
    const StepPlan& plan;
    const StepInput& input;
    std::span<Rank> ranks;  // those at work on this cloth
    unsigned rank_count() const { return static_cast<unsigned>(ranks.size()); }
    ParticleView particles;
    float h, max_speed, viscous, half_thickness, depenetration;  // as in FrameNumbers
};

Executor::Frame Executor::make_frame(const Job& job, std::span<Rank> ranks) {
    ClothState& cloth = *job.cloth;
    const FrameNumbers numbers = frame_numbers(*cloth.model, *job.plan, job.input->dt);
    return {.cloth = cloth,
            .plan = *job.plan,
            .input = *job.input,
            .ranks = ranks,
            .particles = cloth.now.view(),
            .h = numbers.h,
            .max_speed = numbers.max_speed,
            .viscous = numbers.viscous,
            .half_thickness = numbers.half_thickness,
            .depenetration = numbers.depenetration};
}

void Executor::run(std::span<Job> jobs, std::array<double, stage_count>& stage_ms) {
    std::uint32_t limit = largest_small_cloth + 1;
    const auto is_small = [&](const Job& job) { return job.cloth->model->particle_count < limit; };
    if (std::ranges::count_if(jobs, is_small) < static_cast<std::ptrdiff_t>(team_.ranks())) limit = smallest_shared_;
    small_.clear();
    for (Job& job : jobs) {
        if (is_small(job)) small_.push_back(&job);
        // All on this thread: nobody could catch what fails on another.
        job.cloth->prepare(*job.plan, job.input->colliders.size(), is_small(job) ? 1 : team_.ranks(),
                           job.input->feedback);
    }
    const bool side_by_side = team_.ranks() > 1 && small_.size() > 1;
    for (Job& job : jobs) {
        if (!is_small(job)) {
            run_together(job, ranks_, stage_ms);
        } else if (!side_by_side) {
            run_together(job, std::span(ranks_).first(1), stage_ms);
        }
    }
    if (side_by_side) run_side_by_side(stage_ms);
}

void Executor::run_together(Job& job, std::span<Rank> ranks, std::array<double, stage_count>& stage_ms) {
    job.cloth->begin_frame(*job.plan);
    const Frame frame = make_frame(job, ranks);
    for (Rank& rank : ranks) rank.reports = report_none;
    if (ranks.size() == 1) {
        run_rank(frame, 0, stage_ms);
    } else {
        std::array<double, stage_count> unused{};
        team_.run([&](unsigned rank) { run_rank(frame, rank, rank == 0 ? stage_ms : unused); });
    }
    job.cloth->end_frame(*job.plan, job.input->dt);
    job.reports = report_none;
    for (const Rank& rank : ranks) job.reports |= rank.reports;
}

void Executor::run_side_by_side(std::array<double, stage_count>& stage_ms) {
    std::ranges::sort(small_, [](const Job* a, const Job* b) {
        const std::uint32_t na = a->cloth->model->particle_count, nb = b->cloth->model->particle_count;
        return na != nb ? na > nb : a < b;
    });
    std::atomic<std::size_t> next = 0;
    team_.run([&](unsigned rank) {
        Rank& mine = ranks_[rank];
        mine.stage_ms.fill(0);
        for (std::size_t i = next.fetch_add(1); i < small_.size(); i = next.fetch_add(1)) {
            Job& job = *small_[i];
            job.cloth->begin_frame(*job.plan);
            mine.reports = report_none;
            run_rank(make_frame(job, std::span(&mine, 1)), 0, mine.stage_ms);
            job.cloth->end_frame(*job.plan, job.input->dt);
            job.reports = mine.reports;
        }
    });
    for (const Rank& rank : ranks_) {
        for (std::uint32_t stage = 0; stage < stage_count; ++stage)
            stage_ms[stage] += rank.stage_ms[stage] / static_cast<double>(ranks_.size());
    }
}

void Executor::run_rank(const Frame& frame, unsigned rank, std::array<double, stage_count>& stage_ms) {
    const FlushSubnormals flush;
    std::array<double, stage_count> mine{};
    StageClock clock(mine);
    keep_last_good(frame, rank);
    Pass last{.kind = PassKind::predict};  // like it, the copy above keeps to this rank's own particles
    const auto meet = [&] {
        if (frame.ranks.size() > 1) team_.meet();
    };
    const auto run_list = [&](std::span<const Pass> passes, std::uint32_t substep) {
        for (const Pass& pass : passes) {
            if (needs_barrier(last, pass)) meet();
            clock.enter(stage_of(pass));
            run_pass(frame, pass, substep, rank);
            last = pass;
        }
    };
    run_list(frame.plan.frame_begin, 0);
    // Where a substep ends as the next one begins, with the particles one by one, both are one pass over them.
    const std::span<const Pass> substep_passes(frame.plan.substep);
    const bool together = !substep_passes.empty() && substep_passes.front().kind == PassKind::predict &&
                          substep_passes.back().kind == PassKind::velocities;
    for (std::uint32_t substep = 0; substep < frame.plan.substeps; ++substep) {
        const bool begun = together && substep > 0, goes_on = together && substep + 1 < frame.plan.substeps;
        run_list(substep_passes.subspan(begun, substep_passes.size() - begun - goes_on), substep);
        if (!goes_on) continue;
        if (needs_barrier(last, substep_passes.back())) meet();
        clock.enter(stage_of(substep_passes.back()));
        run_advance(frame, rank);
        last = substep_passes.front();
    }
    run_list(frame.plan.frame_end, frame.plan.substeps - 1);
    meet();
    check_finite(frame, rank);
    count_contacts(frame, rank);
    clock.stop();
    if (rank == 0) {
        for (std::uint32_t stage = 0; stage < stage_count; ++stage) stage_ms[stage] += mine[stage];
    }
}

void Executor::run_advance(const Frame& frame, unsigned rank) {
    const Share mine = share_of(padded(frame.cloth.model->point_count()), lane_padding, rank, frame.rank_count());
    if (passes_.advance(frame.particles, {mine.begin, mine.end}, frame.input.gravity, frame.max_speed, frame.h))
        frame.ranks[rank].reports |= report_speed_capped;
}

void Executor::run_pass(const Frame& frame, const Pass& pass, std::uint32_t substep, unsigned rank) {
    const ClothModel& model = *frame.cloth.model;
    const Share mine = share_of(padded(model.point_count()), lane_padding, rank, frame.rank_count());
    const Range particles{mine.begin, mine.end};
    bool capped = false;
    switch (pass.kind) {
        case PassKind::predict:
            capped = passes_.predict(frame.particles, particles, frame.input.gravity, frame.max_speed, frame.h);
            break;
        case PassKind::hold:
            run_holds(frame, substep, mine);
            break;
        case PassKind::velocities:
            capped = passes_.velocities(frame.particles, particles, frame.max_speed, frame.h);
            break;
        case PassKind::project:
        case PassKind::damp:
            run_rows(frame, pass, substep, rank);
            break;
        case PassKind::contact:
            run_contacts(frame, pass, substep, rank);
            break;
        case PassKind::collect:
        case PassKind::lift:
        case PassKind::reach:
        case PassKind::settle:
            run_level(frame, pass, rank);
            break;
        case PassKind::spread:
            passes_.spread(frame.particles.position, frame.cloth.carry_to_particles(),
                           level_range(frame, model.particle_count, rank));
            break;
        case PassKind::correct:
            run_corrections(frame, pass, substep, rank);
            break;
        case PassKind::average:
            passes_.average(frame.particles, frame.cloth.gather_view(frame.plan),
                            {mine.begin, std::min(mine.end, model.point_count())});
            break;
        case PassKind::wind:
        case PassKind::air:
        case PassKind::faces:
            run_faces(frame, pass, rank);
            break;
        case PassKind::push:
            passes_.push(frame.particles, frame.cloth.air(frame.input.air_density),
                         {mine.begin, std::min(mine.end, model.particle_count)});
            break;
        case PassKind::normals:
            passes_.normals(frame.cloth.surface(), {mine.begin, std::min(mine.end, model.particle_count)});
            break;
    }
    if (capped) frame.ranks[rank].reports |= report_speed_capped;
}

// Lambda is read again by a later iteration; that of stretch, after the last substep, by whoever asks for the tension
// in the cloth or the residual.
LambdaUse Executor::lambda_use(const Frame& frame, const Pass& pass, std::uint32_t substep) {
    if (!pass.first_iteration) return LambdaUse::accumulate;
    const bool kept =
        frame.plan.iterations > 1 || (pass.constraint == ConstraintKind::stretch && substep + 1 == frame.plan.substeps);
    return kept ? LambdaUse::store : LambdaUse::discard;
}

void Executor::run_lines(const Frame& frame, const Pass& pass, std::uint32_t substep, unsigned rank) {
    const ConstraintTable& table = frame.cloth.model->table(pass.constraint);
    const std::span<const LineBlock> blocks =
        share_of_blocks(table, table.batches[pass.batch], rank, frame.rank_count());
    const RowView rows = frame.cloth.rows(pass.constraint);
    if (blocks.empty()) return;
    const Range range{blocks.front().begin, blocks.back().end()};
    const auto kind = static_cast<std::uint32_t>(pass.constraint);
    if (pass.kind == PassKind::damp) {
        passes_.damp[kind](frame.particles, rows, range, frame.viscous);
    } else if (frame.plan.method == Method::pbd) {
        passes_.project_plain[kind](frame.particles, rows, range, frame.plan.stiffness[kind]);
    } else if (frame.plan.projection == Projection::lines) {
        passes_.lines(frame.particles, rows, blocks, frame.h, lambda_use(frame, pass, substep),
                      frame.cloth.line_scratch[rank].data());
    } else {
        // The next ones go on along the lines, from particles that these move.
        for (std::uint32_t r = range.begin; r < range.end; r += lane_padding) {
            passes_.project[kind](frame.particles, rows, {r, r + lane_padding}, frame.h,
                                  lambda_use(frame, pass, substep));
        }
    }
}

void Executor::run_rows(const Frame& frame, const Pass& pass, std::uint32_t substep, unsigned rank) {
    const ConstraintTable& table = frame.cloth.model->table(pass.constraint);
    const Batch& batch = table.batches[pass.batch];
    if (batch.blocks > 0) return run_lines(frame, pass, substep, rank);
    const Passes& passes = batch.serial ? scalar_passes() : passes_;
    Range range{batch.begin, batch.begin + batch.rows};
    if (batch.serial) {
        if (rank != 0) return;
    } else {
        const Share share = share_of(padded(batch.rows), lane_padding, rank, frame.rank_count());
        range = {batch.begin + share.begin, batch.begin + share.end};
    }
    const auto kind = static_cast<std::uint32_t>(pass.constraint);
    const RowView rows = frame.cloth.rows(pass.constraint);
    if (pass.kind == PassKind::damp) {
        passes.damp[kind](frame.particles, rows, range, frame.viscous);
    } else if (frame.plan.method == Method::pbd) {
        passes.project_plain[kind](frame.particles, rows, range, frame.plan.stiffness[kind]);
    } else {
        passes.project[kind](frame.particles, rows, range, frame.h, lambda_use(frame, pass, substep));
    }
}

void Executor::run_corrections(const Frame& frame, const Pass& pass, std::uint32_t substep, unsigned rank) {
    const ConstraintTable& table = frame.cloth.model->table(pass.constraint);
    // Side by side no two rows write to the same place: colors and the overflow do not matter.
    const Share share = share_of(table.stride, lane_padding, rank, frame.rank_count());
    passes_.correct[static_cast<std::uint32_t>(pass.constraint)](
        frame.particles, frame.cloth.rows(pass.constraint), frame.cloth.correction(pass.constraint, frame.plan),
        {share.begin, share.end}, frame.h, lambda_use(frame, pass, substep));
}

Range Executor::level_range(const Frame& frame, std::uint32_t count, unsigned rank) {
    const Share share = share_of(padded(count), lane_padding, rank, frame.rank_count());
    return {share.begin, share.end};
}

void Executor::run_level(const Frame& frame, const Pass& pass, unsigned rank) {
    if (pass.alone && rank != 0) return;
    ClothState& cloth = frame.cloth;
    const CoarseLevel& level = cloth.model->hierarchy[pass.level];
    const auto range_of = [&](std::uint32_t count) {
        return pass.alone ? Range{0, padded(count)} : level_range(frame, count, rank);
    };
    const Range mine = range_of(level.count);
    if (pass.kind == PassKind::collect) {
        const float* finer = pass.level == 0 ? frame.particles.position : cloth.level(pass.level - 1).origin;
        passes_.collect(finer, cloth.level(pass.level), mine);
        return;
    }
    if (pass.kind == PassKind::lift) {
        passes_.lift(cloth.level(pass.level), cloth.carry_to_level(pass.level), mine);
        return;
    }
    if (pass.kind == PassKind::settle) {
        passes_.settle(cloth.level(pass.level), mine);
        return;
    }
    const Batch& batch = level.reach.batches[pass.batch];
    const auto kind = static_cast<std::uint32_t>(ConstraintKind::reach);
    const LambdaUse use = pass.first_iteration ? LambdaUse::store : LambdaUse::accumulate;
    const Range rows = range_of(batch.rows);
    if (!batch.serial) {
        passes_.project[kind](cloth.level_particles(pass.level), cloth.level_rows(pass.level),
                              {batch.begin + rows.begin, batch.begin + rows.end}, frame.h, use);
    } else if (rank == 0) {
        scalar_passes().project[kind](cloth.level_particles(pass.level), cloth.level_rows(pass.level),
                                      {batch.begin, batch.begin + batch.rows}, frame.h, use);
    }
}

void Executor::run_faces(const Frame& frame, const Pass& pass, unsigned rank) {
    const Share share = share_of(frame.cloth.model->face_stride, lane_padding, rank, frame.rank_count());
    const Range range{share.begin, share.end};
    if (pass.kind == PassKind::faces) {
        passes_.faces(frame.cloth.surface(), range);
        return;
    }
    const AirView air = frame.cloth.air(frame.input.air_density);
    if (pass.kind == PassKind::air) {
        passes_.air(air, range, frame.h);
        return;
    }
    bool first = true;
    for (const WindNow& wind : frame.input.winds) {
        passes_.wind[static_cast<std::uint32_t>(wind.kind)](air, wind, first, range);
        first = false;
    }
}

void Executor::run_holds(const Frame& frame, std::uint32_t substep, Share mine) {
    const auto held = std::ranges::lower_bound(frame.input.held, mine.begin, {}, &HeldParticle::particle);
    for (auto it = held; it != frame.input.held.end() && it->particle < mine.end; ++it) {
        const Pose& pose = frame.input.mover_poses[std::size_t{substep + 1} * frame.input.movers + it->mover];
        const Vec3 x = to_world(pose, it->local);
        Vec4& position = frame.cloth.now.position[it->particle];
        position = {x.x, x.y, x.z, position.w};
    }
}

void Executor::run_contacts(const Frame& frame, const Pass& pass, std::uint32_t substep, unsigned rank) {
    const ClothModel& model = *frame.cloth.model;
    const Share share = share_of(padded(model.point_count()), lane_padding, rank, frame.rank_count());
    const std::size_t count = frame.input.colliders.size();
    for (std::size_t i = 0; i < count; ++i) {
        const Collider& collider = frame.input.colliders[i];
        const auto [static_friction, kinetic_friction] = friction_between(model, collider);
        ContactView view{
            .numbers = collider.numbers,
            .now = frame.input.poses[(substep + 1) * count + i],
            .before = frame.input.poses[substep * count + i],
            .static_friction = static_friction,
            .kinetic_friction = kinetic_friction,
            .half_thickness = frame.half_thickness,
            .depenetration = frame.depenetration,
            .sums = frame.cloth.contact_sums.empty() ? nullptr : &frame.cloth.contact_sums[i * model.capacity()].x,
            .first_iteration = pass.first_iteration,
        };
        const auto shape = static_cast<std::uint32_t>(collider.shape);
        if (frame.cloth.account.empty()) {
            passes_.contact[shape](frame.particles, view, {share.begin, share.end});
            continue;
        }
        view.moved = frame.cloth.account.moved(i);
        view.turned = frame.cloth.account.turned(i);
        view.first_of_frame = substep == 0 && pass.first_iteration;
        passes_.contact_traced[shape](frame.particles, view, {share.begin, share.end});
    }
}

void Executor::count_contacts(const Frame& frame, unsigned rank) {
    if (frame.cloth.account.empty()) return;
    const ClothModel& model = *frame.cloth.model;
    Share share = share_of(padded(model.point_count()), lane_padding, rank, frame.rank_count());
    share.end = std::min(share.end, model.particle_count);
    frame.cloth.account.count(rank, share, frame.cloth.now.position, 1.0f / frame.h);
}

void Executor::keep_last_good(const Frame& frame, unsigned rank) {
    const Share share = share_of(padded(frame.cloth.model->point_count()), lane_padding, rank, frame.rank_count());
    frame.cloth.remember(share.begin, share.end);
}

void Executor::check_finite(const Frame& frame, unsigned rank) {
    const Share share = share_of(padded(frame.cloth.model->point_count()), lane_padding, rank, frame.rank_count());
    const std::size_t begin = std::size_t{4} * share.begin, end = std::size_t{4} * share.end;
    for (const float* array : {frame.particles.position, frame.particles.velocity, frame.particles.carry}) {
        if (!passes_.all_finite(array, begin, end)) frame.ranks[rank].reports |= report_non_finite;
    }
}

std::string Executor::find_non_finite(ClothState& cloth, const StepPlan& plan, const StepInput& input) {
    const std::size_t points = cloth.model->point_count();
    const std::span positions = std::span(cloth.now.position).first(points);
    const std::span velocities = std::span(cloth.now.velocity).first(points);
    if (std::string culprit = name_input(input, positions, velocities); !culprit.empty()) return culprit;
    const FlushSubnormals flush;
    Rank rank;
    const Frame frame = make_frame({&cloth, &plan, &input}, std::span(&rank, 1));
    for (const Pass& pass : plan.frame_begin) run_pass(frame, pass, 0, 0);
    for (std::uint32_t substep = 0; substep < plan.substeps; ++substep) {
        for (const Pass& pass : plan.substep) {
            run_pass(frame, pass, substep, 0);
            const std::uint32_t p = first_non_finite(positions, velocities);
            if (p != none) return name_pass(*cloth.model, pass, substep, p);
        }
    }
    return std::string(late_non_finite);
}

}  // namespace weft::cpu
