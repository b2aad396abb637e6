#include "cpu/cloth_state.h"

#include "solver/plan/frame_numbers.h"

#include <algorithm>
#include <cassert>

namespace weft::cpu {

ClothState::ClothState(std::shared_ptr<const ClothModel> cloth_model, WorldArrays& arrays, std::uint32_t begin)
    : model(std::move(cloth_model)), world(arrays), base(begin) {
    const Particles mine = now();
    for (const auto& array : {mine.start, mine.velocity, mine.compensation, normals()})
        std::ranges::fill(array, Vec4{});
    std::ranges::copy(model->start, mine.position.begin());
    std::ranges::transform(model->start, weights().begin(), &Vec4::w);
    std::ranges::copy(start_velocities(*model), mine.velocity.begin());
    remember();
    kept().resize(model->kept_floats());
    find_halves();
    begin_tearing();
    take_thickness();
    by_face.resize(std::size_t{model->face_stride} + 1);
    update_normals();
}

void ClothState::set_model(std::shared_ptr<const ClothModel> other, std::uint32_t new_base) {
    assert(other->first_anchor() == model->first_anchor());
    // Anchors of two different sets do not correspond; the new ones start at the model's positions.
    const bool same_anchors = other->anchor_count == model->anchor_count;
    const std::uint32_t count = same_anchors ? other->point_count() : other->first_anchor();
    const auto copy_of = [&](std::span<Vec4> array) {
        return AlignedVector<Vec4>(array.begin(), array.begin() + count);
    };
    const Particles old = now();
    const auto position = copy_of(old.position), start = copy_of(old.start), velocity = copy_of(old.velocity),
               compensation = copy_of(old.compensation);
    const std::shared_ptr<const ClothModel> before = std::exchange(model, std::move(other));
    base = new_base;
    const Particles mine = now();
    std::ranges::copy(model->start, mine.position.begin());
    std::ranges::transform(model->start, weights().begin(), &Vec4::w);
    for (std::uint32_t p = 0; p < count; ++p) {
        const Vec4& x = position[p];
        mine.position[p] = {x.x, x.y, x.z, weights()[p]};
    }
    const auto put = [&](const AlignedVector<Vec4>& from, std::span<Vec4> to) {
        std::ranges::copy(from, to.begin());
        std::ranges::fill(to.subspan(count), Vec4{});
    };
    put(start, mine.start), put(velocity, mine.velocity), put(compensation, mine.compensation);
    remember();
    const std::vector<float> kept_before(kept().begin(), kept().end());
    for (auto& of_table : lambda) of_table.clear();
    const std::vector<float> still = kept_after(*before, kept_before, *model);
    kept().assign(still.begin(), still.end());
    find_halves();
    begin_tearing();
    take_thickness();
    gather = nullptr;
    face_mass.clear();
    levels.clear();
    account = {};
    by_face.assign(std::size_t{model->face_stride} + 1, Vec4{});
    std::ranges::fill(normals(), Vec4{});
    update_normals();
}

void ClothState::set_material(std::shared_ptr<const ClothModel> other) {
    assert(other->point_count() == model->point_count());
    const bool same_masses = other->mass.shares(model->mass);
    model = std::move(other);
    begin_tearing();
    if (!same_masses) weigh();
}

void ClothState::take_thickness() {
    thickness_factors.assign(model->thickness_factors.begin(), model->thickness_factors.end());
}

// Keeps the current pins, not the model's.
void ClothState::weigh() {
    face_mass.clear();
    const std::span<Vec4> position = now().position;
    const std::span<float> weight = weights();
    for (std::uint32_t p = 0; p < model->particle_count; ++p) {
        const float unpinned = 1 / model->mass[p];
        weight[p] = position[p].w = weight[p] > 0 ? unpinned : 0;
    }
}

void ClothState::set_topology(std::shared_ptr<const ClothModel> other, std::span<const std::uint32_t> copied) {
    assert(other->capacity() == model->capacity());
    const Particles mine = now();
    for (std::size_t i = 0; i < copied.size(); ++i) {
        const std::size_t to = model->particle_count + i, from = copied[i];
        for (const auto& array : {mine.position, mine.start, mine.velocity, mine.compensation}) array[to] = array[from];
        mine.position[to].w = weights()[to] = 0;
    }
    const bool same_masses = other->mass.shares(model->mass);
    const bool same_levels = other->hierarchy.shares(model->hierarchy);
    const bool same_faces = other->faces.shares(model->faces);
    // After a frame in which the cloth has torn, its arrays are those of the new model already.
    const bool torn = tearing && !tearing->openings().empty() && other->tear_law == model->tear_law &&
                      other->copied_from.size() == tearing->arrays().copied_from.size();
    const auto shares_rows = [](const ConstraintTable& a, const ConstraintTable& b) {
        return a.particles.shares(b.particles) && a.fields.shares(b.fields);
    };
    const bool only_levels = tearing && tearing->openings().empty() && same_faces && same_masses &&
                             other->tear_law == model->tear_law &&
                             std::ranges::equal(other->constraints, model->constraints, shares_rows);
    model = std::move(other);
    find_halves();
    if (only_levels) {
        // the arrays stay as they are
    } else if (torn) {
        tearing->set_model(*model);
    } else {
        begin_tearing();
    }
    take_thickness();
    gather = nullptr;
    if (!same_masses) weigh();
    if (!same_levels) levels.clear();
    if (!same_faces) update_normals();
}

void ClothState::place_points(std::uint32_t first, std::span<const Vec3> places) {
    const Particles mine = now();
    for (std::size_t i = 0; i < places.size(); ++i) {
        const std::size_t p = first + i;
        mine.position[p] = mine.start[p] = {places[i].x, places[i].y, places[i].z, 0};
        mine.velocity[p] = mine.compensation[p] = {};
        weights()[p] = 0;
    }
}

ClothSnapshot ClothState::save() const {
    const auto points = [&](std::span<const Vec4> array) {
        return std::vector<Vec4>(array.begin(), array.begin() + model->point_count());
    };
    const Particles mine = now();
    ClothSnapshot snapshot{.position = points(mine.position),
                           .start = points(mine.start),
                           .velocity = points(mine.velocity),
                           .compensation = points(mine.compensation),
                           .kept = {kept().begin(), kept().end()},
                           .substep_seconds = substep_seconds};
    for (std::size_t p = 0; p < snapshot.position.size(); ++p) snapshot.position[p].w = weights()[p];
    return snapshot;
}

void ClothState::restore(const ClothSnapshot& snapshot) {
    const Particles mine = now();
    std::ranges::copy(snapshot.position, mine.position.begin());
    std::ranges::transform(snapshot.position, weights().begin(), &Vec4::w);
    std::ranges::copy(snapshot.start, mine.start.begin());
    std::ranges::copy(snapshot.velocity, mine.velocity.begin());
    std::ranges::copy(snapshot.compensation, mine.compensation.begin());
    std::ranges::copy(snapshot.kept, kept().begin());
    substep_seconds = snapshot.substep_seconds;
    remember();
    update_normals();
}

void ClothState::set_weights(std::span<const ParticleWeight> changed) {
    for (const auto& [particle, weight] : changed) {
        weights()[particle] = weight;
        now().position[particle].w = weight;
    }
}

void ClothState::update_normals() {
    const SurfaceView view = surface();
    scalar_passes().faces(view, {0, model->face_stride});
    normals_pass(view, {0, model->particle_count});
    scalar_passes().smooth_faces(view, {0, model->face_stride});
    normals_pass(view, {0, model->particle_count});
}

void ClothState::remember() {
    remember(0, model->capacity());
}

void ClothState::remember(std::size_t begin, std::size_t end) {
    for (std::size_t p = base + begin; p < base + end; ++p) {
        const Vec4& x = world.position[p];
        world.good_position[p] = {x.x, x.y, x.z, world.start[p].w};
    }
    const auto copy = [&](const AlignedVector<Vec4>& from, AlignedVector<Vec4>& to) {
        std::copy(from.data() + base + begin, from.data() + base + end, to.data() + base + begin);
    };
    copy(world.velocity, world.good_velocity);
    copy(world.compensation, world.good_compensation);
}

// Written so that compilers make one vector operation of each line.
Bounds ClothState::bounds() const {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    std::array<float, 4> low{infinity, infinity, infinity, infinity}, high{-infinity, -infinity, -infinity, -infinity};
    for (const Vec4& x : world.range(base, model->particle_count).position) {
        const std::array<float, 4> place{x.x, x.y, x.z, 0};
        for (int k = 0; k < 4; ++k) low[k] = place[k] < low[k] ? place[k] : low[k];
        for (int k = 0; k < 4; ++k) high[k] = place[k] > high[k] ? place[k] : high[k];
    }
    return {{low[0], low[1], low[2]}, {high[0], high[1], high[2]}};
}

void ClothState::roll_back() {
    if (tearing) tearing->roll_back(*model, weights());
    for (std::size_t p = base; p < std::size_t{base} + model->capacity(); ++p) {
        const Vec4& x = world.good_position[p];
        world.start[p] = x;
        world.position[p] = {x.x, x.y, x.z, world.weight[p]};
        world.velocity[p] = world.good_velocity[p];
        world.compensation[p] = world.good_compensation[p];
    }
    std::ranges::copy(good_kept, kept().begin());
    std::ranges::fill(remainder, Vec4{});
}

RowView ClothState::rows(ConstraintKind kind) {
    const ConstraintTable& table = model->table(kind);
    float* const multipliers = lambda[static_cast<std::uint32_t>(kind)].data();
    float* const shifts = table.is_coupled() ? kept().data() + model->first_shift() : nullptr;
    if (!tearing) return {table.stride, table.particles.data(), table.fields.data(), multipliers, limits, shifts};
    const OpenedArrays::Rows& torn = tearing->arrays().rows[static_cast<std::uint32_t>(kind)];
    return {table.stride, torn.particles.data(), torn.fields.data(), multipliers, limits, shifts};
}

std::span<const LineBlock> ClothState::blocks() const {
    return tearing ? tearing->arrays().blocks : model->table(ConstraintKind::stretch).blocks;
}

const std::uint32_t* ClothState::faces() const {
    return tearing ? tearing->arrays().faces.data() : model->faces.data();
}

std::uint32_t ClothState::points_in_use() const {
    if (model->anchor_count > 0) return model->point_count();  // anchors follow the reserve
    return tearing ? tearing->arrays().particle_count : model->particle_count;
}

void ClothState::begin_tearing() {
    tearing = model->tear_law ? std::make_unique<Tearing>(*model) : nullptr;
}

void ClothState::find_halves() {
    const ConstraintTable& table = model->table(ConstraintKind::stretch);
    halves_used_.assign(table.second_halves / lane_padding, 0);
    for (std::uint32_t row = 0; row < table.second_halves; ++row)
        if (!table.is_dummy(table.particles[table.second_halves + row])) halves_used_[row / lane_padding] = 1;
}

bool ClothState::uses_halves(std::uint32_t begin, std::uint32_t end) const {
    const std::uint32_t first = model->table(ConstraintKind::stretch).second_halves;
    const std::vector<std::uint8_t>& all = tearing ? tearing->arrays().halves_used : halves_used_;
    return std::any_of(all.begin() + (begin - first) / lane_padding, all.begin() + (end - first) / lane_padding,
                       [](std::uint8_t used) { return used != 0; });
}

SurfaceView ClothState::surface() {
    return {&now().position[0].x, faces(), model->face_stride, &by_face[0].x, view_of(*model->around), &normals()[0].x};
}

SupportView ClothState::support_view() {
    if (supports.empty()) return {};
    const std::size_t stride = supports.size() / support_arrays;
    const auto array = [&](std::size_t number) { return &supports[number * stride].x; };
    return {array(0), array(1), array(2), array(3), array(4)};
}

void ClothState::clear_supports(Range particles) {
    const std::size_t stride = supports.size() / support_arrays;
    for (std::size_t array = 0; array < support_arrays; ++array)
        std::fill(&supports[array * stride + particles.begin], &supports[array * stride] + particles.end, Vec4{});
}

void ClothState::clear_taken(Range particles) {
    Vec4* taken = &supports[supports.size() / support_arrays];
    std::fill(taken + particles.begin, taken + particles.end, Vec4{});
}

LevelView ClothState::level(std::uint32_t i, bool heavy) {
    LevelState& state = levels[i];
    const CoarseLevel& level = model->hierarchy[i];
    const Restriction& from = level.restriction;
    return {&state.position[0].x,
            &state.origin[0].x,
            &state.displacement[0].x,
            state.remainder.empty() ? nullptr : &state.remainder[0].x,
            from.begin.data(),
            from.node.data(),
            from.weight.data(),
            level.weight.data(),
            heavy && i == 0 ? weights().data() : nullptr,
            heavy};
}

// The loops over constraints treat the nodes of a level as particles.
ParticleView ClothState::level_particles(std::uint32_t i) {
    ParticleView view{&levels[i].position[0].x, nullptr, nullptr, nullptr};
    if (!levels[i].remainder.empty()) view.remainder = &levels[i].remainder[0].x;
    return view;
}

RowView ClothState::level_rows(std::uint32_t i) {
    const ConstraintTable& table = model->hierarchy[i].limits;
    return {table.stride, table.particles.data(), table.fields.data(), levels[i].lambda.data(), limits};
}

ProlongationView ClothState::prolongation_to_level(std::uint32_t i) const {
    if (i + 1 == levels.size()) return {};
    return prolongation_from(i + 1);
}

ProlongationView ClothState::prolongation_to_particles() const {
    return prolongation_from(0);
}

ProlongationView ClothState::prolongation_from(std::uint32_t i) const {
    const Prolongation& prolongation = model->hierarchy[i].prolongation;
    return {&levels[i].displacement[0].x, prolongation.stride,
            prolongation.narrow.empty() ? nullptr : prolongation.narrow.data(),
            prolongation.wide.empty() ? nullptr : prolongation.wide.data(), prolongation.weight.data()};
}

AirView ClothState::air(float density) {
    const AirMaterial& fabric = model->fabric.air;
    const Particles mine = now();
    return {.position = &mine.position[0].x,
            .velocity = &mine.velocity[0].x,
            .faces = faces(),
            .stride = model->face_stride,
            .mass = face_mass.data(),
            .wind = wind.empty() ? nullptr : &wind[0].x,
            .sheltered = nullptr,
            .impulse = &by_face[0].x,
            .drag = 0.5f * density * fabric.drag,
            .lift = 0.5f * density * fabric.lift,
            .sine_lift = fabric.lift_model == LiftModel::sine,
            .around = view_of(*model->around)};
}

GatherView ClothState::gather_view(const WorldPlan& plan) const {
    return {&corrections[0].x, gather->offsets.data(), gather->items.data(), plan.method == Method::pbd,
            plan.accumulate == Accumulate::fixed_point};
}

CorrectionView ClothState::correction(ConstraintKind kind, const WorldPlan& plan, const PlainStiffness& stiffness) {
    const auto index = static_cast<std::uint32_t>(kind);
    return {.blocks = &corrections[gather->first[index]].x,
            .share = plan.method == Method::pbd ? nullptr : gather->share[index].data(),
            .stiffness = stiffness[index]};
}

void ClothState::end_frame(const WorldPlan& plan, double dt) {
    substep_seconds = lambda_seconds(plan, dt);
}

void ClothState::begin_frame(const WorldPlan& plan) {
    limits = {};
    if (!has_limits(*model, plan)) return;
    const FrameLimits found = frame_limits(*model, kept(), substep_seconds, now().position);
    limits = {found.tension, found.allowed};
}

void ClothState::prepare(const WorldPlan& plan, std::size_t colliders, unsigned workers, bool contact_forces,
                         bool bodies) {
    const auto has = [](const std::vector<Pass>& passes, PassKind kind) {
        return std::ranges::find(passes, kind, &Pass::kind) != passes.end();
    };
    face_contacts.prepare(model->capacity(), model->face_stride,
                          has_face_contact(plan) ? static_cast<std::uint32_t>(colliders) : 0, workers);
    wind.resize(has(plan.frame_begin, PassKind::wind) ? model->face_stride : 0);
    sheltered.resize(colliders > 0 ? wind.size() : 0);
    sheltering.resize(sheltered.empty() ? 0 : workers);
    for (std::vector<std::uint32_t>& numbers : sheltering) numbers.reserve(colliders);
    if (has(plan.substep, PassKind::air) && face_mass.empty()) {
        const std::vector<float> masses = face_masses(*model);
        face_mass.assign(masses.begin(), masses.end());
    }
    if (has(plan.substep, PassKind::prolongation) && levels.empty()) {
        for (const CoarseLevel& coarse : model->hierarchy) {
            LevelState& state = levels.emplace_back();
            state.position.resize(coarse.capacity());
            state.origin.resize(coarse.capacity());
            state.displacement.resize(coarse.capacity());
            state.lambda.resize(coarse.limits.stride);
        }
    }
    for (std::size_t i = 0; i < levels.size(); ++i)
        levels[i].remainder.resize(plan.compensated ? model->hierarchy[i].capacity() : 0);
    remainder.resize(plan.compensated ? model->capacity() : 0);
    for (const ConstraintTable& table : model->constraints) {
        auto& of_table = lambda[static_cast<std::uint32_t>(table.kind)];
        const std::size_t count = stores_lambda(plan, table, *model) ? table.lambda_count() : 0;
        if (table.kind != ConstraintKind::stretch && of_table.size() != count) of_table.assign(count, 0.0f);
    }
    if (const std::size_t count = plan.steadies && model->has_pin_loads() ? model->capacity() : 0;
        count != steady_parts.size()) {
        steady_parts.assign(count, 1.0f);
        steadied.assign(count / lane_padding + 1, 0);
    }
    taut.resize(plan.weighs_taut ? model->capacity() : 0);
    good_kept.resize(plan.reads_kept ? kept().size() : 0);
    std::uint32_t longest = 0;
    for (const LineBlock& block : model->table(ConstraintKind::stretch).blocks)
        longest = std::max(longest, block.length);
    if (line_scratch.size() < workers) line_scratch.resize(workers);
    for (auto& scratch : line_scratch) scratch.resize(line_scratch_floats(longest));
    near_colliders.prepare(padded(model->point_count()), static_cast<std::uint32_t>(colliders), workers,
                           bodies || rounds_of(plan, *model) > 1, contact_forces);
    account.prepare(contact_forces ? colliders : 0, workers);
    near_colliders.take_pressed([this](Range particles) { clear_supports(particles); });
    supports.resize(bodies ? support_arrays * std::size_t{padded(model->point_count())} : 0);
    if (plan.projection == Projection::jacobi && !gather) {
        gather = std::make_unique<const JacobiGather>(build_gather(*model));
        corrections.resize(gather->blocks);
    }
}

}  // namespace weft::cpu
