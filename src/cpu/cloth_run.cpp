#include "cpu/cloth_run.h"

#include <algorithm>

namespace weft::cpu {
namespace {

// Whole blocks, distributed so that all workers get nearly the same number of constraints.
std::span<const LineBlock> share_of_blocks(std::span<const LineBlock> blocks, const Batch& batch, Worker worker) {
    const auto bound = [&](unsigned r) {
        const std::uint64_t row = batch.begin + std::uint64_t{batch.rows} * r / worker.count;
        const auto middle = [](const LineBlock& block) { return block.begin + block.length * lane_padding / 2; };
        return std::ranges::lower_bound(blocks, row, {}, middle) - blocks.begin();
    };
    const auto begin = static_cast<std::size_t>(bound(worker.number)),
               end = static_cast<std::size_t>(bound(worker.number + 1));
    return blocks.subspan(begin, end - begin);
}

Range as_range(Share share) {
    return {share.begin, share.end};
}

}  // namespace

ClothRun::ClothRun(const Passes& passes, ClothState& cloth, Bodies& bodies, const WorldStep& step,
                   const ClothStep& mine)
    : passes_(passes),
      cloth_(cloth),
      bodies_(bodies),
      plan_(*step.plan),
      input_(step.input),
      step_(mine),
      planned_{cloth.model.get(), !mine.targets.empty(), !mine.grabs.empty(), !mine.motion_bodies.empty()},
      view_(cloth.now().view()),
      numbers_(frame_numbers(*cloth.model, *step.plan, step.input.dt)) {
    if (!cloth.steady_parts.empty())
        view_.steady_parts = cloth.steady_parts.data(), view_.steadied = cloth.steadied.data();
    if (!cloth.remainder.empty()) view_.remainder = &cloth.remainder[0].x;
}

Range ClothRun::particles(Worker worker) const {
    return as_range(worker.of(padded(model().point_count())));
}

// Of the worker's particles: passes over particles have no barrier between them, so each worker keeps its own.
Range ClothRun::particles_in_use(Worker worker) const {
    const Range mine = particles(worker);
    const std::uint32_t end = padded(cloth_.points_in_use());
    return {std::min(mine.begin, end), std::min(mine.end, end)};
}

bool ClothRun::run(const IslandPass& island_pass, std::uint32_t substep, Worker worker) const {
    const Pass& pass = island_pass.pass;
    if (!island_pass.all && !takes_part(planned_, pass)) return false;
    if (is_face_contact(pass.kind)) {
        run_face_contact(pass, substep, worker);
        return false;
    }
    if (is_grab(pass.kind)) {
        if (worker.number == 0) run_grabs(pass, substep);
        return false;
    }
    if (pass.kind == PassKind::tear) {
        if (worker.number == 0)
            cloth_.tearing->run(passes_, model(), {cloth_.now(), cloth_.weights(), cloth_.thickness_factors}, substep);
        return false;
    }
    switch (pass_info(pass.kind).over) {
        case Over::particles:
            return run_particles(pass, substep, worker);
        case Over::faces:
            run_faces(pass, worker);
            break;
        case Over::nodes:
            run_level(island_pass, substep, worker);
            break;
        case Over::rows:
            if (pass.source == RowSource::level) {
                run_level(island_pass, substep, worker);
            } else if (pass.kind == PassKind::correct) {
                run_corrections(pass, substep, worker);
            } else {
                run_rows(pass, substep, worker);
            }
            break;
    }
    return false;
}

// Makes particles near pins heavier until `release`. Most packets of particles have none.
void ClothRun::steady(Range mine) const {
    const float h = numbers_.h;
    const scalar::Step step = scalar::step_without_limits(h, 1 / h, 1 / h / h);
    const std::span<const float> weights = cloth_.weights();
    for (std::uint32_t begin = mine.begin; begin < mine.end; begin += lane_padding) {
        const std::span steadiness(model().steadiness.data() + begin, lane_padding);
        std::uint8_t& steadied = cloth_.steadied[begin / lane_padding];
        const bool any = std::ranges::any_of(steadiness, [](float s) { return s > 0; });
        if (!any && !steadied) continue;
        steadied = any;
        for (std::uint32_t p = begin; p < begin + lane_padding; ++p) {
            const float part = scalar::steady_part(model().steadiness[p], weights[model().pin_of[p]], step);
            cloth_.steady_parts[p] = part;
            cloth_.now().position[p].w = weights[p] * part;
        }
    }
}

void ClothRun::release(Range mine) const {
    for (std::uint32_t begin = mine.begin; begin < mine.end; begin += lane_padding) {
        if (!cloth_.steadied[begin / lane_padding]) continue;
        for (std::uint32_t p = begin; p < begin + lane_padding; ++p) cloth_.now().position[p].w = cloth_.weights()[p];
    }
}

bool ClothRun::run_particles(const Pass& pass, std::uint32_t substep, Worker worker) const {
    const Range mine = particles(worker);
    // Anchors have no triangles, and coarse levels do not move them.
    const auto without_anchors = [&](std::uint32_t end) { return Range{mine.begin, std::min(mine.end, end)}; };
    switch (pass.kind) {
        case PassKind::predict:
            return passes_.predict(view_, particles_in_use(worker), input_.gravity, numbers_.max_speed, numbers_.h);
        case PassKind::advance:
            return passes_.advance(view_, particles_in_use(worker), input_.gravity, numbers_.max_speed, numbers_.h);
        case PassKind::velocities:
            return passes_.velocities(view_, particles_in_use(worker), numbers_.max_speed, numbers_.h);
        case PassKind::targets:
            run_targets(pass, substep, mine);
            break;
        case PassKind::weigh_attached:
        case PassKind::pull_bodies:
            run_attached(pass, mine, worker);
            break;
        case PassKind::steady:
            steady(mine);
            break;
        case PassKind::take_taut:
            passes_.take_taut(view_, &cloth_.taut[0].x, mine);
            break;
        case PassKind::release:
            release(mine);
            break;
        case PassKind::free_taut:
            for (std::uint32_t p = mine.begin; p < mine.end; ++p) cloth_.now().position[p].w = cloth_.weights()[p];
            break;
        case PassKind::count_touches:
        case PassKind::touch_bodies:
            run_body_contacts(pass, substep, mine, worker);
            break;
        case PassKind::contact:
            run_contacts(pass, substep, mine, worker);
            break;
        case PassKind::prolongation:
            passes_.prolongation(view_, cloth_.prolongation_to_particles(),
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

void ClothRun::run_lines(const Pass& pass, std::uint32_t substep, Worker worker) const {
    const ConstraintTable& table = model().table(pass.constraint);
    const Batch& batch = table.batches[pass.batch];
    if (batch.halves) {
        // Few are in use, and their padding shares dummies, so one thread runs them.
        if (worker.number != 0) return;
        const auto all = cloth_.blocks().subspan(batch.first_block, batch.blocks);
        for (const LineBlock& block : all)
            if (cloth_.uses_halves(block.begin, block.end())) run_blocks(pass, substep, std::span(&block, 1), worker);
        return;
    }
    const std::span<const LineBlock> blocks =
        share_of_blocks(cloth_.blocks().subspan(batch.first_block, batch.blocks), batch, worker);
    if (!blocks.empty()) run_blocks(pass, substep, blocks, worker);
}

void ClothRun::run_blocks(const Pass& pass, std::uint32_t substep, std::span<const LineBlock> blocks,
                          Worker worker) const {
    const RowView rows = cloth_.rows(pass.constraint);
    const Range range{blocks.front().begin, blocks.back().end()};
    const auto kind = static_cast<std::uint32_t>(pass.constraint);
    if (pass.kind == PassKind::damp) {
        passes_.damp[kind](view_, rows, range, numbers_.viscous);
    } else if (pass.kind == PassKind::weigh_taut) {
        passes_.weigh_taut(view_, rows, range, numbers_.h, &cloth_.taut[0].x);
    } else if (plan_.method == Method::pbd) {
        passes_.project_plain[kind](view_, rows, range, (*step_.stiffness)[kind]);
    } else if (plan_.projection == Projection::lines) {
        passes_.lines(view_, rows, blocks, numbers_.h, use_of_lambda(pass, substep),
                      cloth_.line_scratch[worker.number].data());
    } else {
        // One packet at a time: the next packet continues the same lines, so it starts at particles that this one
        // moves.
        for (std::uint32_t r = range.begin; r < range.end; r += lane_padding) {
            passes_.project[kind](view_, rows, {r, r + lane_padding}, numbers_.h, use_of_lambda(pass, substep));
        }
    }
}

void ClothRun::run_rows(const Pass& pass, std::uint32_t substep, Worker worker) const {
    const ConstraintTable& table = model().table(pass.constraint);
    if (pass.kind == PassKind::couple)
        return passes_.couple(cloth_.rows(pass.constraint), {table.coupled.data(), table.coupling.data()},
                              as_range(worker.of(table.stride)), numbers_.h);
    const Batch& batch = table.batches[pass.batch];
    if (batch.blocks > 0) return run_lines(pass, substep, worker);
    if (batch.halves) {
        if (worker.number != 0) return;
        for (std::uint32_t begin = batch.begin; begin < batch.padded_end(); begin += lane_padding) {
            const std::uint32_t end = std::min(begin + lane_padding, batch.begin + batch.rows);
            if (cloth_.uses_halves(begin, begin + lane_padding))
                run_range(pass, substep, {begin, batch.serial ? end : begin + lane_padding}, batch.serial);
        }
    } else if (batch.serial) {
        if (worker.number == 0) run_range(pass, substep, {batch.begin, batch.begin + batch.rows}, true);
    } else {
        const Share share = worker.of(padded(batch.rows));
        run_range(pass, substep, {batch.begin + share.begin, batch.begin + share.end}, false);
    }
}

// `serial`: one constraint after another.
void ClothRun::run_range(const Pass& pass, std::uint32_t substep, Range range, bool serial) const {
    const Passes& passes = serial ? scalar_passes() : passes_;
    const auto kind = static_cast<std::uint32_t>(pass.constraint);
    const RowView rows = cloth_.rows(pass.constraint);
    if (pass.kind == PassKind::damp) {
        passes.damp[kind](view_, rows, range, numbers_.viscous);
    } else if (pass.kind == PassKind::weigh_taut) {
        passes.weigh_taut(view_, rows, range, numbers_.h, &cloth_.taut[0].x);
    } else if (plan_.method == Method::pbd) {
        passes.project_plain[kind](view_, rows, range, (*step_.stiffness)[kind]);
    } else {
        passes.project[kind](view_, rows, range, numbers_.h, use_of_lambda(pass, substep));
    }
}

void ClothRun::run_corrections(const Pass& pass, std::uint32_t substep, Worker worker) const {
    // Each constraint writes its corrections to its own place, so colors and the overflow do not matter.
    passes_.correct[static_cast<std::uint32_t>(pass.constraint)](
        view_, cloth_.rows(pass.constraint), cloth_.correction(pass.constraint, plan_, *step_.stiffness),
        as_range(worker.of(model().table(pass.constraint).stride)), numbers_.h, use_of_lambda(pass, substep));
}

// Calls visit(node, position of its particle) for the nodes in this range that are pinned, if any is attached to a
// body.
template <class Visit>
void ClothRun::for_each_pinned(const CoarseLevel& level, Range mine, Visit&& visit) const {
    if (!planned_.attached) return;
    const std::span<Vec4> positions = cloth_.now().position;
    for (auto it = std::ranges::lower_bound(level.pinned, mine.begin); it != level.pinned.end() && *it < mine.end; ++it)
        visit(*it, positions[level.particle[*it]]);
}

// Attached points have masses in the level, and begin where coarser levels have moved them.
void ClothRun::take_attached(std::uint32_t level, Range mine) const {
    LevelState& state = cloth_.levels[level];
    for_each_pinned(model().hierarchy[level], mine, [&](std::uint32_t node, const Vec4& particle) {
        if (!(particle.w < 0)) return;
        state.origin[node] = {particle.x, particle.y, particle.z, 0};
        state.position[node] = {particle.x, particle.y, particle.z, -particle.w};
    });
}

// The particle moves as far as its node. Nodes near it do not: its mass is that of the body, not of cloth.
void ClothRun::give_attached(std::uint32_t level, Range mine) const {
    LevelState& state = cloth_.levels[level];
    for_each_pinned(model().hierarchy[level], mine, [&](std::uint32_t node, Vec4& particle) {
        const Vec4& position = state.position[node];
        if (!(position.w > 0)) return;
        particle = {position.x, position.y, position.z, particle.w};
        state.origin[node] = position;
        if (!state.remainder.empty()) state.remainder[node] = {};
    });
}

void ClothRun::run_level(const IslandPass& island_pass, std::uint32_t substep, Worker worker) const {
    const Pass& pass = island_pass.pass;
    const bool single = island_pass.single;
    if (single && worker.number != 0) return;
    const CoarseLevel& level = model().hierarchy[pass.level];
    const Worker sharing = single ? Worker{} : worker;
    if (pass.kind != PassKind::coarse_limit) {
        const Range mine = as_range(sharing.of(padded(level.count)));
        const LevelView nodes = cloth_.level(pass.level, plan_.weighs_taut);
        if (pass.kind == PassKind::interpolation) {
            passes_.interpolation(nodes, cloth_.prolongation_to_level(pass.level), mine);
            return take_attached(pass.level, mine);
        }
        if (pass.kind == PassKind::node_correction) {
            give_attached(pass.level, mine);
            return passes_.node_correction(nodes, mine);
        }
        const float* finer = pass.level == 0 ? view_.position : &cloth_.levels[pass.level - 1].origin[0].x;
        return passes_.restriction(finer, nodes, mine);
    }
    const Batch& batch = level.limits.batches[pass.batch];
    if (batch.serial && worker.number != 0) return;
    const Share share = sharing.of(padded(batch.rows));
    const Range rows = batch.serial ? Range{batch.begin, batch.begin + batch.rows}
                                    : Range{batch.begin + share.begin, batch.begin + share.end};
    const Passes& passes = batch.serial ? scalar_passes() : passes_;
    passes.project[static_cast<std::uint32_t>(ConstraintKind::coarse_limit)](cloth_.level_particles(pass.level),
                                                                             cloth_.level_rows(pass.level), rows,
                                                                             numbers_.h, use_of_lambda(pass, substep));
}

void ClothRun::run_faces(const Pass& pass, Worker worker) const {
    const Range mine = as_range(worker.of(model().face_stride));
    if (pass.kind == PassKind::faces) return passes_.faces(cloth_.surface(), mine);
    if (pass.kind == PassKind::smooth_faces) return passes_.smooth_faces(cloth_.surface(), mine);
    if (pass.kind == PassKind::watch_tears) return cloth_.tearing->watch(passes_, model(), view_.position, mine);
    const AirView air = cloth_.air(input_.air_density);
    if (pass.kind == PassKind::air) return passes_.air(air, mine, numbers_.h);
    run_winds(air, mine, worker.number);
}

// Calls visit(target, body) for the targets among these particles; `body`: none, or the number of the one it follows.
template <class Visit>
void ClothRun::for_each_target(Range mine, Visit&& visit) const {
    const auto target = std::ranges::lower_bound(step_.targets, mine.begin, {}, &KinematicTarget::particle);
    for (auto it = target; it != step_.targets.end() && it->particle < mine.end; ++it)
        visit(*it, step_.motion_bodies.empty() ? none : step_.motion_bodies[it->motion]);
}

void ClothRun::run_targets(const Pass& pass, std::uint32_t substep, Range mine) const {
    const std::span<Vec4> positions = cloth_.now().position;
    for_each_target(mine, [&](const KinematicTarget& target, std::uint32_t body) {
        if (body == none && pass.batch != targets_all) return;
        const Pose& pose = body == none ? step_.motion_poses[std::size_t{substep + 1} * step_.motions + target.motion]
                                        : bodies_.now(body);
        const Vec3 x = to_world(pose, target.local);
        Vec4& position = positions[target.particle];
        position = {x.x, x.y, x.z, position.w};
    });
}

// Gives points that are attached to bodies a mass, or takes it back and hands what they have been moved by to the
// bodies, with what the air has given them.
void ClothRun::run_attached(const Pass& pass, Range mine, Worker worker) const {
    const std::span<Vec4> positions = cloth_.now().position;
    const bool blown = pass.first_iteration && has_air(plan_);
    const AirView air = cloth_.air(input_.air_density);
    for_each_target(mine, [&](const KinematicTarget& target, std::uint32_t body) {
        if (body == none) return;
        Vec4& position = positions[target.particle];
        const Vec3 place = to_world(bodies_.placed(body), target.local);
        if (pass.kind == PassKind::weigh_attached) {
            const scalar::MovedBody moved = bodies_.moved_by_attached(body);
            const float weight = most_weight_of(moved, scalar::vector_of(place) - moved.center);
            position.w = pass.batch == weigh_for_levels ? -weight : weight;
            return;
        }
        const Vec3 by = position.xyz() - place;
        if (position.w > 0 && dot(by, by) > 0) bodies_.add_push(worker.number, body, -by, place, position.w);
        if (blown && target.particle < model().particle_count && bodies_.feels_cloth(body))
            bodies_.add_impulse(worker.number, body, impulse_of_air(air, target.particle), place);
        position = {place.x, place.y, place.z, 0};
    });
}

void ClothRun::keep_last_good(Worker worker) const {
    const Range mine = particles(worker);
    cloth_.remember(mine.begin, mine.end);
    if (cloth_.good_kept.empty()) return;
    const Share share = worker.of(static_cast<std::uint32_t>(cloth_.good_kept.size()));
    const AlignedVector<float>& kept = cloth_.kept();
    std::copy(kept.begin() + share.begin, kept.begin() + share.end, cloth_.good_kept.begin() + share.begin);
}

bool ClothRun::all_finite(Worker worker) const {
    const Range mine = particles(worker);
    bool finite = true;
    for (const float* array : {view_.position, view_.velocity, view_.compensation})
        finite = finite && passes_.all_finite(array, std::size_t{4} * mine.begin, std::size_t{4} * mine.end);
    return finite;
}

}  // namespace weft::cpu
