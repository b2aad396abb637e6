#include "solver/world/world.h"

#include "base/hash.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <chrono>
#include <cmath>
#include <iterator>
#include <stdexcept>

namespace weft {
namespace {

double ms_since(std::chrono::steady_clock::time_point begin) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
}

std::vector<std::uint32_t> pinned_in(const ClothModel& model) {
    std::vector<std::uint32_t> pinned;
    for (std::uint32_t p = 0; p < model.particle_count; ++p)
        if (!(model.start[p].w > 0)) pinned.push_back(p);
    return pinned;
}

}  // namespace

World::World(std::unique_ptr<Backend> backend, WorldSettings settings)
    : backend_(std::move(backend)), settings_(std::move(settings)) {
    assert(settings_.solver.substeps > 0 && settings_.solver.iterations > 0);
}
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;
World::~World() = default;

Result<ClothId> World::try_add(std::shared_ptr<const ClothModel> model, Holds holds) {
    settle();
    const std::uint32_t base = space_.take(model->capacity());
    const auto handle = backend_->add_cloth(model, base);
    if (!handle) {
        space_.give_back(base, model->capacity());
        return handle.errors();
    }
    Cloth cloth;
    cloth.handle = *handle;
    cloth.pinned = pinned_in(*model);
    cloth.model = std::move(model);
    cloth.holds = std::move(holds);
    cloth.base = base;
    const ClothId id = cloths_.add(std::move(cloth));
    list_cloths();
    replan();
    return id;
}

ClothId World::add(std::shared_ptr<const ClothModel> model, Holds holds) {
    auto id = try_add(std::move(model), std::move(holds));
    if (!id) throw std::runtime_error(id.error().message());
    return *id;
}

void World::remove(ClothId id) {
    assert(contains(id));
    settle();
    const Cloth& cloth = cloths_[cloths_.find(id)];
    backend_->remove_cloth(cloth.handle);
    space_.give_back(cloth.base, cloth.model->capacity());
    cloths_.remove(id);
    pending_.drop(id);
    for (std::size_t i = stitches_.size(); i-- > 0;) {
        const auto of_cloth = [&](const Stitch& stitch) { return stitch.a == id || stitch.b == id; };
        if (std::ranges::any_of(stitches_[i], of_cloth)) stitches_.remove(stitches_.id_of(i));
    }
    list_cloths();
    replan();
}

Result<Done> World::exchange_model(Cloth& cloth, std::shared_ptr<const ClothModel> model) {
    assert(model->first_anchor() == cloth.model->first_anchor());
    const std::uint32_t before = cloth.model->capacity(), after = model->capacity();
    const std::uint32_t base = after == before ? cloth.base : space_.take(after);
    if (auto set = backend_->set_model(cloth.handle, model, base); !set) {
        if (base != cloth.base) space_.give_back(base, after);
        return set;
    }
    if (base != cloth.base) space_.give_back(cloth.base, before);
    cloth.base = base;
    cloth.model = std::move(model);
    cloth.unedited = nullptr;
    cloth.edits.clear();
    cloth.pinned = pinned_in(*cloth.model);
    return Done{};
}

Result<Done> World::set_model(ClothId id, std::shared_ptr<const ClothModel> model, Holds holds) {
    assert(contains(id));
    settle();
    pending_.drop(id);
    Cloth& cloth = cloths_[cloths_.find(id)];
    if (auto set = exchange_model(cloth, std::move(model)); !set) return set;
    cloth.holds = std::move(holds);
    list_cloths();
    replan();
    return Done{};
}

Result<Done> World::set_material(ClothId id, std::shared_ptr<const ClothModel> model) {
    assert(contains(id));
    settle();
    Cloth& cloth = cloths_[cloths_.find(id)];
    auto unedited = with_fabric_unedited(cloth, *model);
    if (!unedited) return unedited.errors();
    if (auto set = backend_->set_material(cloth.handle, model); !set) return set;
    pending_.drop(id);
    cloth.unedited = std::move(*unedited);
    // Of a fabric, plans know nothing but whether it damps.
    const bool same_passes = (cloth.model->fabric.body.damping > 0) == (model->fabric.body.damping > 0);
    cloth.model = std::move(model);
    if (settings_.solver.method == Method::pbd)
        cloth.stiffness = plain_stiffness(cloth.model->fabric, settings_.solver.iterations);
    list_cloths();
    if (!same_passes) replan();
    return Done{};
}

void World::rebuild_later(ClothId id, BuildModel build) {
    assert(contains(id));
    if (!cloths_[cloths_.find(id)].edits.empty()) return;
    const std::uint64_t due = frame_.index + frames_to_build(model(id)->particle_count);
    pending_.add(id, due, std::move(build));
}

// A model that cannot be built, or for which a device has no room, is no reason to stop a cloth that moves.
void World::use_model(const PendingModels::Ready& ready) {
    settle();
    if (!ready.model || !exchange_model(cloths_[cloths_.find(ready.cloth)], *ready.model)) return;
    list_cloths();
    replan();
}

Result<Done> World::set_pins(ClothId id, std::vector<std::uint32_t> pinned, Holds holds) {
    assert(contains(id));
    settle();
    Cloth& cloth = cloths_[cloths_.find(id)];
    std::ranges::sort(pinned);
    pinned.erase(std::ranges::unique(pinned).begin(), pinned.end());
    std::vector<ParticleWeight> changed;
    const auto visit = [&](const auto& from, const auto& other, auto&& weight_of) {
        std::vector<std::uint32_t> only;
        std::ranges::set_difference(from, other, std::back_inserter(only));
        for (const std::uint32_t p : only) changed.push_back({p, weight_of(p)});
    };
    visit(pinned, cloth.pinned, [](std::uint32_t) { return 0.0f; });
    visit(cloth.pinned, pinned, [&](std::uint32_t p) { return 1 / cloth.model->mass[p]; });
    if (auto set = backend_->set_weights(cloth.handle, changed); !set) return set;
    cloth.pinned = std::move(pinned);
    const bool replanned = cloth.holds.particles.empty() != holds.particles.empty();
    cloth.holds = std::move(holds);
    cloth.mover_poses.resize((std::size_t{settings_.solver.substeps} + 1) * cloth.holds.movers.size());
    unread_ = true;
    if (replanned) replan();
    return Done{};
}

StitchId World::add(std::vector<Stitch> stitches) {
    settle();
    const StitchId id = stitches_.add(std::move(stitches));
    replan();
    return id;
}

void World::remove(StitchId id) {
    assert(contains(id));
    settle();
    stitches_.remove(id);
    replan();
}

ColliderId World::add(Collider collider) {
    settle();
    const ColliderId id = colliders_.add(std::move(collider));
    replan();
    return id;
}

void World::remove(ColliderId id) {
    assert(contains(id));
    settle();
    const Pose last = collider(id).pose;
    for (Cloth& cloth : cloths_) {
        for (std::uint32_t m = 0; m < cloth.holds.movers.size(); ++m) {
            if (cloth.holds.movers[m].collider != id) continue;
            cloth.holds.movers[m] = {};
            for (HeldParticle& held : cloth.holds.particles) {
                if (held.mover == m) held.local = to_world(last, held.local);
            }
        }
    }
    colliders_.remove(id);
    replan();
}

void World::set_friction(ColliderId id, std::array<float, 2> friction) {
    assert(contains(id));
    complete();  // the frame that runs has the friction that it began with
    colliders_[colliders_.find(id)].friction = friction;
}

void World::move(ColliderId id, const Pose& to) {
    assert(contains(id));
    Collider& collider = colliders_[colliders_.find(id)];
    collider.motion.clear();
    collider.next_pose = to;
}

void World::configure(WorldSettings settings) {
    assert(settings.solver.substeps > 0 && settings.solver.iterations > 0);
    settle();
    settings_ = std::move(settings);
    if (!settings_.feedback) {
        felt_ = {};
        feedback_ = {};
    }
    replan();
}

void World::list_cloths() {
    frame_.cloths.resize(cloths_.size());
    for (std::size_t i = 0; i < cloths_.size(); ++i) {
        frame_.cloths[i].id = cloths_.id_of(i);
        frame_.cloths[i].model = cloths_[i].model.get();
    }
    unread_ = true;
}

const Frame& World::frame() const {
    complete();
    if (!unread_) return frame_;
    for (std::size_t i = 0; i < cloths_.size(); ++i) {
        backend_->read(cloths_[i].handle, frame_.cloths[i]);
        frame_.cloths[i].invalidate();
    }
    unread_ = false;
    return frame_;
}

void World::replan() {
    const bool air = settings_.air && settings_.air->density > 0;
    const StepSettings settings{
        .solver = settings_.solver,
        .contacts = !colliders_.empty(),
        .air = air,
        .wind = air && !settings_.air->wind.empty(),
        .adhesion = std::ranges::any_of(colliders_, [](const Collider& c) { return !!c.adhesion; }),
        .surface = settings_.surface};
    const std::size_t places = std::size_t{settings_.solver.substeps} + 1;
    std::vector<PlannedCloth> planned;
    for (Cloth& cloth : cloths_) {
        planned.push_back({cloth.model.get(), !cloth.holds.particles.empty()});
        if (settings_.solver.method == Method::pbd)
            cloth.stiffness = plain_stiffness(cloth.model->fabric, settings_.solver.iterations);
        cloth.mover_poses.resize(places * cloth.holds.movers.size());
    }
    poses_.resize(places * colliders_.size());
    winds_.resize(air ? settings_.air->wind.size() : 0);

    make_islands();
    std::vector<const LinkTables*> links;
    for (const Island& island : islands_)
        if (island.linked) links.push_back(&island.links);
    plan_ = plan_world(settings, planned, links);
    std::vector<PlannedCloth> members;
    for (Island& island : islands_) {
        members.clear();
        for (const std::uint32_t place : island.cloths) members.push_back(planned[place]);
        island.plan = IslandPlan(plan_, members, island.linked ? &island.links : nullptr);
    }
    ++plan_serial_;
}

// Cloths that stitches tie together, and their stitches with particles numbered over the world.
void World::make_islands() {
    std::vector<std::array<std::uint32_t, 2>> ties;
    const auto place_of = [&](ClothId id) { return static_cast<std::uint32_t>(cloths_.find(id)); };
    for (const auto& group : stitches_)
        for (const Stitch& stitch : group) ties.push_back({place_of(stitch.a), place_of(stitch.b)});
    islands_.clear();
    std::vector<std::size_t> island_of(cloths_.size());
    for (auto& cloths : group_islands(static_cast<std::uint32_t>(cloths_.size()), ties)) {
        for (const std::uint32_t place : cloths) island_of[place] = islands_.size();
        islands_.push_back({.cloths = std::move(cloths), .links = {}, .linked = false, .plan = {}, .steps = {}});
    }
    if (ties.empty()) return;
    std::vector<std::vector<PlacedStitch>> placed(islands_.size());
    const auto in_world = [&](StitchPoint point, ClothId id) {
        for (std::uint32_t& p : point.particles) p += cloths_[cloths_.find(id)].base;
        return point;
    };
    for (const auto& group : stitches_) {
        for (const Stitch& stitch : group)
            placed[island_of[place_of(stitch.a)]].push_back(
                {in_world(stitch.from, stitch.a), in_world(stitch.to, stitch.b), stitch.gap, stitch.compliance});
    }
    for (std::size_t i = 0; i < islands_.size(); ++i) {
        const Cloth& first = cloths_[islands_[i].cloths.front()];
        islands_[i].links = make_links(placed[i], first.base + first_dummy(first.model->room()));
        islands_[i].linked = !placed[i].empty();
    }
}

// Where every collider is at the start of the frame and after each substep.
void World::place_colliders(double dt) {
    const std::size_t count = colliders_.size();
    for (std::uint32_t substep = 0; substep <= settings_.solver.substeps; ++substep) {
        const double time = frame_.time + dt * substep / settings_.solver.substeps;
        const float fraction = static_cast<float>(substep) / static_cast<float>(settings_.solver.substeps);
        for (std::size_t i = 0; i < count; ++i) {
            const Collider& collider = colliders_[i];
            poses_[substep * count + i] =
                collider.next_pose ? between(collider.pose, *collider.next_pose, fraction) : pose_at(collider, time);
        }
    }
}

void World::place_movers(Cloth& cloth, double dt) const {
    const std::size_t count = cloth.holds.movers.size();
    for (std::size_t i = 0; i < count; ++i) {
        const Mover& mover = cloth.holds.movers[i];
        const std::size_t collider = colliders_.find(mover.collider);
        for (std::uint32_t substep = 0; substep <= settings_.solver.substeps; ++substep) {
            const double time = frame_.time + dt * substep / settings_.solver.substeps;
            cloth.mover_poses[substep * count + i] = collider < colliders_.size()
                                                         ? poses_[substep * colliders_.size() + collider]
                                                         : Pose{{}, offset_at(mover.offsets, time)};
        }
    }
}

void World::advance(double dt) {
    assert(dt > 0 && std::isfinite(dt));
    complete();
    while (const auto ready = pending_.take_due(frame_.index + 1)) use_model(*ready);
    if (settings_.background) pending_.start_next();
    place_colliders(dt);
    for (Cloth& cloth : cloths_) place_movers(cloth, dt);
    for (std::size_t i = 0; i < winds_.size(); ++i) {
        winds_[i] = wind_at(settings_.air->wind[i], frame_.time + 0.5 * dt);
    }
    const auto begin = std::chrono::steady_clock::now();
    frame_.index += 1;
    frame_.time += dt;
    frame_.reports = report_none;
    frame_.stage_ms.fill(0);
    FrameFeedback& felt = begin_feedback(dt);
    steps_.clear();
    for (Island& island : islands_) {
        island.steps.clear();
        for (const std::uint32_t place : island.cloths) {
            const Cloth& cloth = cloths_[place];
            island.steps.push_back({.cloth = cloth.handle,
                                    .stiffness = &cloth.stiffness,
                                    .held = cloth.holds.particles,
                                    .mover_poses = cloth.mover_poses,
                                    .movers = static_cast<std::uint32_t>(cloth.holds.movers.size()),
                                    .frame = &frame_.cloths[place],
                                    .feedback = settings_.feedback ? &felt.cloths[place].feedback : nullptr});
        }
        steps_.push_back({.plan = &island.plan,
                          .cloths = island.steps,
                          .links = island.linked ? &island.links : nullptr,
                          .links_serial = plan_serial_});
    }
    step_ = {.plan = &plan_,
             .plan_serial = plan_serial_,
             .input = {.dt = dt,
                       .gravity = settings_.gravity,
                       .air_density = settings_.air ? settings_.air->density : 0,
                       .winds = winds_,
                       .colliders = colliders_.values(),
                       .poses = poses_,
                       .feedback = settings_.feedback,
                       .list_capacity = settings_.list_capacity},
             .islands = steps_};
    backend_->step(step_);
    running_ = true;
    for (std::size_t i = 0; i < colliders_.size(); ++i) {
        colliders_[i].pose = poses_[settings_.solver.substeps * colliders_.size() + i];
        colliders_[i].next_pose.reset();
    }
    frame_.step_ms = ms_since(begin);
}

void World::complete() const {
    if (!running_) return;
    running_ = false;
    const auto begin = std::chrono::steady_clock::now();
    backend_->finish(frame_.stage_ms);
    frame_.lists = backend_->list_counts();
    unread_ = true;
    for (const ClothFrame& cloth : frame_.cloths) frame_.reports |= cloth.reports;
    if (settings_.feedback) not_made_out_ = static_cast<std::uint32_t>(frame_.index % felt_.size());
    frame_.step_ms += ms_since(begin);
}

// Who takes part in the frame that begins.
FrameFeedback& World::begin_feedback(double dt) {
    FrameFeedback& felt = felt_[frame_.index % felt_.size()];
    if (!settings_.feedback) return felt;
    felt.frame = frame_.index;
    felt.dt = dt;
    felt.colliders.clear();
    for (std::size_t i = 0; i < colliders_.size(); ++i) felt.colliders.push_back(colliders_.id_of(i));
    felt.cloths.resize(cloths_.size());
    for (std::size_t i = 0; i < cloths_.size(); ++i) {
        felt.cloths[i].id = cloths_.id_of(i);
        felt.cloths[i].model = cloths_[i].model;
        felt.cloths[i].feedback.contacts = {};
        felt.cloths[i].feedback.sums.assign(colliders_.size(), {});
    }
    return felt;
}

const Feedback& World::feedback() const {
    if (not_made_out_) make_out(felt_[*not_made_out_], feedback_, vertices_);
    not_made_out_.reset();
    return feedback_;
}

void World::settle() {
    complete();
    (void)feedback();
}

Snapshot World::save() {
    complete();
    while (const auto ready = pending_.take_any()) use_model(*ready);
    Snapshot snapshot{.frame = frame_.index, .time = frame_.time, .cloths = {}, .colliders = {}};
    for (const Cloth& cloth : cloths_) {
        snapshot.cloths.push_back(backend_->save(cloth.handle));
        snapshot.cloths.back().holds = save_holds(cloth.holds);
        snapshot.cloths.back().edits = cloth.edits;
    }
    for (const Collider& collider : colliders_) snapshot.colliders.push_back(collider.pose);
    return snapshot;
}

SavedHolds World::save_holds(const Holds& holds) const {
    SavedHolds saved;
    saved.particles = holds.particles;
    for (const Mover& mover : holds.movers) {
        const std::size_t place = colliders_.find(mover.collider);
        saved.movers.push_back({place < colliders_.size() ? static_cast<std::uint32_t>(place) : none, mover.offsets});
    }
    return saved;
}

Holds World::restore_holds(const SavedHolds& saved) const {
    Holds holds;
    holds.particles = saved.particles;
    for (const SavedMover& mover : saved.movers)
        holds.movers.push_back(
            {mover.collider == none ? ColliderId{} : colliders_.id_of(mover.collider), mover.offsets});
    return holds;
}

Result<Done> World::check_fits(const Snapshot& snapshot) const {
    const auto differs = [](const char* what, std::size_t got, std::size_t expected) {
        return Error{"state",
                     "has " + std::to_string(got) + ' ' + what + ", here there are " + std::to_string(expected)};
    };
    if (snapshot.cloths.size() != cloths_.size()) return differs("cloths", snapshot.cloths.size(), cloths_.size());
    if (snapshot.colliders.size() != colliders_.size())
        return differs("colliders", snapshot.colliders.size(), colliders_.size());
    for (std::size_t i = 0; i < cloths_.size(); ++i) {
        const ClothSnapshot& saved = snapshot.cloths[i];
        const std::size_t points = cloths_[i].model->point_count();
        const std::size_t rows = cloths_[i].model->table(ConstraintKind::stretch).lambda_count();
        const std::string of_cloth = "particles in cloth '" + cloths_[i].model->name + "'";
        for (const auto* array : {&saved.position, &saved.start, &saved.velocity, &saved.carry}) {
            if (array->size() != points) return differs(of_cloth.c_str(), array->size(), points);
        }
        if (saved.lambda.size() != rows) return differs("rows of stretch", saved.lambda.size(), rows);
        for (const SavedMover& mover : saved.holds.movers) {
            if (mover.collider != none && mover.collider >= colliders_.size())
                return differs("colliders that carry pins", mover.collider + std::size_t{1}, colliders_.size());
        }
        for (const HeldParticle& held : saved.holds.particles) {
            if (held.particle >= points || held.mover >= saved.holds.movers.size())
                return Error{"state", "holds particle " + std::to_string(held.particle) + " of cloth '" +
                                          cloths_[i].model->name + "', which it has not"};
        }
    }
    return check_numbers(snapshot);
}

Result<Done> World::restore(const Snapshot& snapshot) {
    complete();
    while (const auto ready = pending_.take_any()) use_model(*ready);
    if (auto fits = check_fits(snapshot); !fits) return fits;
    std::vector<std::shared_ptr<const ClothModel>> edited;
    for (std::size_t i = 0; i < cloths_.size(); ++i) {
        auto model = edited_model(cloths_[i], snapshot.cloths[i].edits);
        if (!model) return model.errors();
        edited.push_back(std::move(*model));
    }
    for (std::size_t i = 0; i < cloths_.size(); ++i) {
        Cloth& cloth = cloths_[i];
        if (auto set = set_edits(cloth, snapshot.cloths[i].edits, std::move(edited[i])); !set) return set;
        if (auto restored = backend_->restore(cloth.handle, snapshot.cloths[i]); !restored) return restored;
        cloth.holds = restore_holds(snapshot.cloths[i].holds);
        cloth.pinned.clear();
        for (std::uint32_t p = 0; p < cloth.model->particle_count; ++p)
            if (!(snapshot.cloths[i].position[p].w > 0)) cloth.pinned.push_back(p);
    }
    for (std::size_t i = 0; i < colliders_.size(); ++i) {
        colliders_[i].pose = snapshot.colliders[i];
        colliders_[i].next_pose.reset();
    }
    frame_.index = snapshot.frame;
    frame_.time = snapshot.time;
    frame_.reports = report_none;
    not_made_out_.reset();
    feedback_ = {};
    list_cloths();
    replan();
    return Done{};
}

ClothMeasures World::measure() const {
    complete();
    MeasureSums sums;
    for (const Cloth& cloth : cloths_) backend_->measure(cloth.handle, sums);
    return sums.result();
}

std::string World::state_hash() const {
    complete();
    StateHash hash;
    for (const Cloth& cloth : cloths_) {
        backend_->hash(cloth.handle, hash);
        hash_edits(cloth, hash);
    }
    return hash.text();
}

}  // namespace weft
