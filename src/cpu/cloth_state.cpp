#include "cpu/cloth_state.h"

#include "solver/plan/frame_numbers.h"

#include <algorithm>
#include <cassert>

namespace weft::cpu {
ClothState::ClothState(std::shared_ptr<const ClothModel> cloth_model) : model(std::move(cloth_model)) {
    const std::size_t capacity = model->capacity();
    now.position = model->start;
    now.start.resize(capacity);
    now.velocity.resize(capacity);
    now.carry.resize(capacity);
    remember();
    stretch_lambda().resize(model->table(ConstraintKind::stretch).lambda_count());
    by_face.resize(std::size_t{model->face_stride} + 1);
    normals.resize(capacity);
    update_normals();
}

void ClothState::set_model(std::shared_ptr<const ClothModel> other) {
    assert(other->particle_count == model->particle_count);
    const auto keep = [&](AlignedVector<Vec4>& array, const auto& fresh) {
        AlignedVector<Vec4> next(other->capacity());
        for (std::uint32_t p = 0; p < other->capacity(); ++p) next[p] = fresh(p);
        // Of another set of anchors nobody can tell which is which; they start where the model has them.
        const bool same_anchors = other->anchor_count == model->anchor_count;
        for (std::uint32_t p = 0; p < (same_anchors ? other->point_count() : other->particle_count); ++p) {
            const float w = next[p].w;
            next[p] = array[p];
            if (&array == &now.position) next[p].w = w;
        }
        array = std::move(next);
    };
    const auto zero = [](std::uint32_t) { return Vec4{}; };
    keep(now.position, [&](std::uint32_t p) { return other->start[p]; });
    keep(now.start, zero);
    keep(now.velocity, zero);
    keep(now.carry, zero);
    remember();
    model = std::move(other);
    for (auto& of_table : lambda) of_table.clear();
    stretch_lambda().assign(model->table(ConstraintKind::stretch).lambda_count(), 0.0f);
    gather = nullptr;
    face_mass.clear();
    levels.clear();
    contact_sums.clear();
    account = {};
    by_face.assign(std::size_t{model->face_stride} + 1, Vec4{});
    normals.assign(model->capacity(), Vec4{});
    update_normals();
}

ClothSnapshot ClothState::save() const {
    const auto points = [&](const AlignedVector<Vec4>& array) {
        return std::vector<Vec4>(array.begin(), array.begin() + model->point_count());
    };
    ClothSnapshot snapshot{.position = points(now.position),
                           .start = points(now.start),
                           .velocity = points(now.velocity),
                           .carry = points(now.carry),
                           .lambda = {stretch_lambda().begin(), stretch_lambda().end()},
                           .substep_seconds = substep_seconds};
    for (Vec4& p : snapshot.position) p.w = 0;
    return snapshot;
}

void ClothState::restore(const ClothSnapshot& snapshot) {
    for (std::uint32_t p = 0; p < model->point_count(); ++p) {
        const Vec4& x = snapshot.position[p];
        now.position[p] = {x.x, x.y, x.z, model->start[p].w};
    }
    std::ranges::copy(snapshot.start, now.start.begin());
    std::ranges::copy(snapshot.velocity, now.velocity.begin());
    std::ranges::copy(snapshot.carry, now.carry.begin());
    std::ranges::copy(snapshot.lambda, stretch_lambda().begin());
    substep_seconds = snapshot.substep_seconds;
    remember();
    update_normals();
}

void ClothState::update_normals() {
    const SurfaceView view = surface();
    scalar_passes().faces(view, {0, model->face_stride});
    normals_pass(view, {0, model->particle_count});
}

void ClothState::remember() {
    for (auto* array : {&last_good.position, &last_good.velocity, &last_good.carry}) array->resize(now.position.size());
    remember(0, now.position.size());
}

void ClothState::remember(std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p) {
        const Vec4& x = now.position[p];
        last_good.position[p] = {x.x, x.y, x.z, now.start[p].w};
    }
    const auto copy = [&](const AlignedVector<Vec4>& from, AlignedVector<Vec4>& to) {
        std::copy(from.data() + begin, from.data() + end, to.data() + begin);
    };
    copy(now.velocity, last_good.velocity);
    copy(now.carry, last_good.carry);
}

void ClothState::roll_back() {
    for (std::size_t p = 0; p < now.position.size(); ++p) {
        const Vec4& x = last_good.position[p];
        now.start[p] = x;
        now.position[p] = {x.x, x.y, x.z, model->start[p].w};
    }
    now.velocity = last_good.velocity;
    now.carry = last_good.carry;
}

RowView ClothState::rows(ConstraintKind kind) {
    const ConstraintTable& table = model->table(kind);
    return {table.stride, table.particles.data(), table.fields.data(), lambda[static_cast<std::uint32_t>(kind)].data(),
            limits};
}

SurfaceView ClothState::surface() {
    return {&now.position[0].x, model->faces.data(),    model->face_stride,
            &by_face[0].x,      view_of(model->around), &normals[0].x};
}

LevelView ClothState::level(std::uint32_t i) {
    LevelState& state = levels[i];
    const Restriction& from = model->hierarchy[i].restriction;
    return {&state.position[0].x, &state.origin[0].x, &state.displacement[0].x,
            from.begin.data(),    from.node.data(),   from.weight.data()};
}

// Rows between nodes are rows like any other.
ParticleView ClothState::level_particles(std::uint32_t i) {
    return {&levels[i].position[0].x, nullptr, nullptr, nullptr};
}

RowView ClothState::level_rows(std::uint32_t i) {
    const ConstraintTable& table = model->hierarchy[i].reach;
    return {table.stride, table.particles.data(), table.fields.data(), levels[i].lambda.data(), limits};
}

CarryView ClothState::carry_to_level(std::uint32_t i) const {
    if (i + 1 == levels.size()) return {};
    return carry_from(i + 1);
}

CarryView ClothState::carry_to_particles() const {
    return carry_from(0);
}

CarryView ClothState::carry_from(std::uint32_t i) const {
    const Carry& carry = model->hierarchy[i].carry;
    return {&levels[i].displacement[0].x, carry.stride, carry.narrow.empty() ? nullptr : carry.narrow.data(),
            carry.wide.empty() ? nullptr : carry.wide.data(), carry.weight.data()};
}

AirView ClothState::air(float density) {
    const AirMaterial& fabric = model->fabric.air;
    return {.position = &now.position[0].x,
            .velocity = &now.velocity[0].x,
            .faces = model->faces.data(),
            .stride = model->face_stride,
            .mass = face_mass.data(),
            .wind = wind.empty() ? nullptr : &wind[0].x,
            .impulse = &by_face[0].x,
            .drag = 0.5f * density * fabric.drag,
            .lift = 0.5f * density * fabric.lift,
            .listing = fabric.lift_model == LiftModel::listing,
            .around = view_of(model->around)};
}

GatherView ClothState::gather_view(const StepPlan& plan) const {
    return {&corrections[0].x, gather->offsets.data(), gather->items.data(), plan.method == Method::pbd,
            plan.accumulate == Accumulate::fixed_point};
}

CorrectionView ClothState::correction(ConstraintKind kind, const StepPlan& plan) {
    const auto index = static_cast<std::uint32_t>(kind);
    return {.blocks = &corrections[gather->first[index]].x,
            .share = plan.method == Method::pbd ? nullptr : gather->share[index].data(),
            .stiffness = plan.stiffness[index]};
}

void ClothState::end_frame(const StepPlan& plan, double dt) {
    substep_seconds = lambda_seconds(plan, dt);
}

void ClothState::begin_frame(const StepPlan& plan) {
    limits = {};
    if (!has_limits(*model, plan)) return;
    const FrameLimits found = frame_limits(*model, stretch_lambda(), substep_seconds, now.position);
    limits = {found.tension, found.allowed};
}

void ClothState::prepare(const StepPlan& plan, std::size_t colliders, unsigned ranks, bool feedback) {
    const auto has = [](const std::vector<Pass>& passes, PassKind kind) {
        return std::ranges::find(passes, kind, &Pass::kind) != passes.end();
    };
    wind.resize(has(plan.frame_begin, PassKind::wind) ? model->face_stride : 0);
    if (has(plan.substep, PassKind::air) && face_mass.empty()) {
        const std::vector<float> masses = face_masses(*model);
        face_mass.assign(masses.begin(), masses.end());
    }
    if (has(plan.substep, PassKind::spread) && levels.empty()) {
        for (const CoarseLevel& coarse : model->hierarchy) {
            LevelState& state = levels.emplace_back();
            state.position.resize(coarse.capacity());
            state.origin.resize(coarse.capacity());
            state.displacement.resize(coarse.capacity());
            state.lambda.resize(coarse.reach.stride);
            for (std::uint32_t node = 0; node < coarse.count; ++node) state.position[node].w = coarse.weight[node];
        }
    }
    for (const ConstraintTable& table : model->constraints) {
        auto& of_table = lambda[static_cast<std::uint32_t>(table.kind)];
        const std::size_t count = plan.iterations > 1 ? table.lambda_count() : 0;
        if (table.kind != ConstraintKind::stretch && of_table.size() != count) of_table.assign(count, 0.0f);
    }
    std::uint32_t longest = 0;
    for (const LineBlock& block : model->table(ConstraintKind::stretch).blocks)
        longest = std::max(longest, block.length);
    if (line_scratch.size() < ranks) line_scratch.resize(ranks);
    for (auto& scratch : line_scratch) scratch.resize(line_scratch_floats(longest));
    const std::size_t sums = plan.iterations > 1 ? colliders * model->capacity() : 0;
    if (contact_sums.size() != sums) contact_sums.assign(sums, Vec4{});
    account.prepare(feedback ? colliders : 0, model->capacity(), ranks);
    if (plan.projection == Projection::jacobi && !gather) {
        gather = std::make_unique<const JacobiGather>(build_gather(*model));
        corrections.resize(gather->blocks);
    }
}

}  // namespace weft::cpu
