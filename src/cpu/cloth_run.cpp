#include "cpu/cloth_run.h"

#include <algorithm>

namespace weft::cpu {
namespace {

// Whole blocks, as nearly as can be as many rows for every rank.
std::span<const LineBlock> share_of_blocks(const ConstraintTable& table, const Batch& batch, Rank rank) {
    const auto blocks = std::span(table.blocks).subspan(batch.first_block, batch.blocks);
    const auto bound = [&](unsigned r) {
        const std::uint64_t row = batch.begin + std::uint64_t{batch.rows} * r / rank.count;
        const auto middle = [](const LineBlock& block) { return block.begin + block.length * lane_padding / 2; };
        return std::ranges::lower_bound(blocks, row, {}, middle) - blocks.begin();
    };
    const auto begin = static_cast<std::size_t>(bound(rank.number)),
               end = static_cast<std::size_t>(bound(rank.number + 1));
    return blocks.subspan(begin, end - begin);
}

Range as_range(Share share) {
    return {share.begin, share.end};
}

}  // namespace

ClothRun::ClothRun(const Passes& passes, ClothState& cloth, const WorldStep& step, const ClothStep& mine)
    : passes_(passes),
      cloth_(cloth),
      plan_(*step.plan),
      input_(step.input),
      step_(mine),
      planned_{cloth.model.get(), !mine.held.empty()},
      view_(cloth.now().view()),
      numbers_(frame_numbers(*cloth.model, *step.plan, step.input.dt)) {}

Range ClothRun::particles(Rank rank) const {
    return as_range(rank.of(padded(model().point_count())));
}

bool ClothRun::run(const IslandPass& island_pass, std::uint32_t substep, Rank rank) const {
    const Pass& pass = island_pass.pass;
    if (!takes_part(planned_, pass)) return false;
    switch (pass_info(pass.kind).over) {
        case Over::particles:
            return run_particles(pass, substep, rank);
        case Over::faces:
            run_faces(pass, rank);
            break;
        case Over::nodes:
            run_level(island_pass, substep, rank);
            break;
        case Over::rows:
            if (pass.source == RowSource::level) {
                run_level(island_pass, substep, rank);
            } else if (pass.kind == PassKind::correct) {
                run_corrections(pass, substep, rank);
            } else {
                run_rows(pass, substep, rank);
            }
            break;
    }
    return false;
}

bool ClothRun::run_particles(const Pass& pass, std::uint32_t substep, Rank rank) const {
    const Range mine = particles(rank);
    // Anchors have no triangles, and coarse levels do not carry them.
    const auto without_anchors = [&](std::uint32_t end) { return Range{mine.begin, std::min(mine.end, end)}; };
    switch (pass.kind) {
        case PassKind::predict:
            return passes_.predict(view_, mine, input_.gravity, numbers_.max_speed, numbers_.h);
        case PassKind::advance:
            return passes_.advance(view_, mine, input_.gravity, numbers_.max_speed, numbers_.h);
        case PassKind::velocities:
            return passes_.velocities(view_, mine, numbers_.max_speed, numbers_.h);
        case PassKind::hold:
            run_holds(substep, mine);
            break;
        case PassKind::contact:
            run_contacts(pass, substep, mine);
            break;
        case PassKind::spread:
            passes_.spread(view_.position, cloth_.carry_to_particles(),
                           without_anchors(padded(model().particle_count)));
            break;
        case PassKind::average:
            passes_.average(view_, cloth_.gather_view(plan_), without_anchors(model().point_count()));
            break;
        case PassKind::push:
            passes_.push(view_, cloth_.air(input_.air_density), without_anchors(model().particle_count));
            break;
        default:  // normals
            passes_.normals(cloth_.surface(), without_anchors(model().particle_count));
            break;
    }
    return false;
}

void ClothRun::run_lines(const Pass& pass, std::uint32_t substep, Rank rank) const {
    const ConstraintTable& table = model().table(pass.constraint);
    const std::span<const LineBlock> blocks = share_of_blocks(table, table.batches[pass.batch], rank);
    const RowView rows = cloth_.rows(pass.constraint);
    if (blocks.empty()) return;
    const Range range{blocks.front().begin, blocks.back().end()};
    const auto kind = static_cast<std::uint32_t>(pass.constraint);
    if (pass.kind == PassKind::damp) {
        passes_.damp[kind](view_, rows, range, numbers_.viscous);
    } else if (plan_.method == Method::pbd) {
        passes_.project_plain[kind](view_, rows, range, (*step_.stiffness)[kind]);
    } else if (plan_.projection == Projection::lines) {
        passes_.lines(view_, rows, blocks, numbers_.h, lambda_use(plan_, pass, substep),
                      cloth_.line_scratch[rank.number].data());
    } else {
        // The next ones go on along the lines, from particles that these move.
        for (std::uint32_t r = range.begin; r < range.end; r += lane_padding) {
            passes_.project[kind](view_, rows, {r, r + lane_padding}, numbers_.h, lambda_use(plan_, pass, substep));
        }
    }
}

void ClothRun::run_rows(const Pass& pass, std::uint32_t substep, Rank rank) const {
    const ConstraintTable& table = model().table(pass.constraint);
    const Batch& batch = table.batches[pass.batch];
    if (batch.blocks > 0) return run_lines(pass, substep, rank);
    const Passes& passes = batch.serial ? scalar_passes() : passes_;
    Range range{batch.begin, batch.begin + batch.rows};
    if (batch.serial) {
        if (rank.number != 0) return;
    } else {
        const Share share = rank.of(padded(batch.rows));
        range = {batch.begin + share.begin, batch.begin + share.end};
    }
    const auto kind = static_cast<std::uint32_t>(pass.constraint);
    const RowView rows = cloth_.rows(pass.constraint);
    if (pass.kind == PassKind::damp) {
        passes.damp[kind](view_, rows, range, numbers_.viscous);
    } else if (plan_.method == Method::pbd) {
        passes.project_plain[kind](view_, rows, range, (*step_.stiffness)[kind]);
    } else {
        passes.project[kind](view_, rows, range, numbers_.h, lambda_use(plan_, pass, substep));
    }
}

void ClothRun::run_corrections(const Pass& pass, std::uint32_t substep, Rank rank) const {
    // Side by side no two rows write to the same place: colors and the overflow do not matter.
    passes_.correct[static_cast<std::uint32_t>(pass.constraint)](
        view_, cloth_.rows(pass.constraint), cloth_.correction(pass.constraint, plan_, *step_.stiffness),
        as_range(rank.of(model().table(pass.constraint).stride)), numbers_.h, lambda_use(plan_, pass, substep));
}

void ClothRun::run_level(const IslandPass& island_pass, std::uint32_t substep, Rank rank) const {
    const auto& [pass, barrier, single] = island_pass;
    if (single && rank.number != 0) return;
    const CoarseLevel& level = model().hierarchy[pass.level];
    const Rank sharing = single ? Rank{} : rank;
    const Range mine = as_range(sharing.of(padded(level.count)));
    if (pass.kind == PassKind::collect) {
        const float* finer = pass.level == 0 ? view_.position : cloth_.level(pass.level - 1).origin;
        return passes_.collect(finer, cloth_.level(pass.level), mine);
    }
    if (pass.kind == PassKind::lift)
        return passes_.lift(cloth_.level(pass.level), cloth_.carry_to_level(pass.level), mine);
    if (pass.kind == PassKind::settle) return passes_.settle(cloth_.level(pass.level), mine);
    const Batch& batch = level.reach.batches[pass.batch];
    if (batch.serial && rank.number != 0) return;
    const Share share = sharing.of(padded(batch.rows));
    const Range rows = batch.serial ? Range{batch.begin, batch.begin + batch.rows}
                                    : Range{batch.begin + share.begin, batch.begin + share.end};
    const Passes& passes = batch.serial ? scalar_passes() : passes_;
    passes.project[static_cast<std::uint32_t>(ConstraintKind::reach)](cloth_.level_particles(pass.level),
                                                                      cloth_.level_rows(pass.level), rows, numbers_.h,
                                                                      lambda_use(plan_, pass, substep));
}

void ClothRun::run_faces(const Pass& pass, Rank rank) const {
    const Range mine = as_range(rank.of(model().face_stride));
    if (pass.kind == PassKind::faces) return passes_.faces(cloth_.surface(), mine);
    const AirView air = cloth_.air(input_.air_density);
    if (pass.kind == PassKind::air) return passes_.air(air, mine, numbers_.h);
    bool first = true;
    for (const WindNow& wind : input_.winds) {
        passes_.wind[static_cast<std::uint32_t>(wind.kind)](air, wind, first, mine);
        first = false;
    }
}

void ClothRun::run_holds(std::uint32_t substep, Range mine) const {
    const auto held = std::ranges::lower_bound(step_.held, mine.begin, {}, &HeldParticle::particle);
    const std::span<Vec4> positions = cloth_.now().position;
    for (auto it = held; it != step_.held.end() && it->particle < mine.end; ++it) {
        const Pose& pose = step_.mover_poses[std::size_t{substep + 1} * step_.movers + it->mover];
        const Vec3 x = to_world(pose, it->local);
        Vec4& position = positions[it->particle];
        position = {x.x, x.y, x.z, position.w};
    }
}

void ClothRun::run_contacts(const Pass& pass, std::uint32_t substep, Range mine) const {
    const std::size_t count = input_.colliders.size();
    for (std::size_t i = 0; i < count; ++i) {
        const Collider& collider = input_.colliders[i];
        const auto [static_friction, kinetic_friction] = friction_between(model(), collider);
        ContactView view{
            .numbers = collider.numbers,
            .now = input_.poses[(substep + 1) * count + i],
            .before = input_.poses[substep * count + i],
            .static_friction = static_friction,
            .kinetic_friction = kinetic_friction,
            .half_thickness = numbers_.half_thickness,
            .depenetration = numbers_.depenetration,
            .sums = cloth_.contact_sums.empty() ? nullptr : &cloth_.contact_sums[i * model().capacity()].x,
            .first_iteration = pass.first_iteration,
        };
        const auto shape = static_cast<std::uint32_t>(collider.shape);
        if (cloth_.account.empty()) {
            passes_.contact[shape](view_, view, mine);
            continue;
        }
        view.moved = cloth_.account.moved(i);
        view.turned = cloth_.account.turned(i);
        view.first_of_frame = substep == 0 && pass.first_iteration;
        passes_.contact_traced[shape](view_, view, mine);
    }
}

void ClothRun::count_contacts(Rank rank) const {
    if (cloth_.account.empty()) return;
    Share share = rank.of(padded(model().point_count()));
    share.end = std::min(share.end, model().particle_count);
    cloth_.account.count(rank.number, share, cloth_.now().position, 1.0f / numbers_.h);
}

void ClothRun::keep_last_good(Rank rank) const {
    const Range mine = particles(rank);
    cloth_.remember(mine.begin, mine.end);
}

bool ClothRun::all_finite(Rank rank) const {
    const Range mine = particles(rank);
    bool finite = true;
    for (const float* array : {view_.position, view_.velocity, view_.carry})
        finite = finite && passes_.all_finite(array, std::size_t{4} * mine.begin, std::size_t{4} * mine.end);
    return finite;
}

}  // namespace weft::cpu
