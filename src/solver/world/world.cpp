#include "solver/world/world.h"

#include "base/disjoint_sets.h"
#include "base/hash.h"
#include "solver/model/collider_surface.h"
#include "solver/plan/frame_numbers.h"

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

}  // namespace

World::World(std::unique_ptr<Backend> backend, WorldSettings settings)
    : backend_(std::move(backend)), settings_(std::move(settings)) {
    assert(settings_.solver.substeps > 0 && settings_.solver.iterations > 0);
}
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;
World::~World() = default;

Result<ClothId> World::try_add(std::shared_ptr<const ClothModel> model, KinematicTargets targets) {
    complete_and_resolve();
    const std::uint32_t base = space_.take(model->capacity());
    const auto handle = backend_->add_cloth(model, base);
    if (!handle) {
        space_.give_back(base, model->capacity());
        return handle.errors();
    }
    Cloth cloth;
    cloth.handle = *handle;
    cloth.pinned = pinned_particles(*model);
    cloth.model = std::move(model);
    cloth.targets = std::move(targets);
    cloth.base = base;
    const ClothId id = cloths_.add(std::move(cloth));
    list_cloths();
    replan();
    return id;
}

ClothId World::add(std::shared_ptr<const ClothModel> model, KinematicTargets targets) {
    auto id = try_add(std::move(model), std::move(targets));
    if (!id) throw std::runtime_error(id.error().message());
    return *id;
}

void World::remove(ClothId id) {
    assert(contains(id));
    complete_and_resolve();
    const Cloth& cloth = cloths_[cloths_.find(id)];
    backend_->remove_cloth(cloth.handle);
    space_.give_back(cloth.base, cloth.model->capacity());
    cloths_.remove(id);
    pending_.drop(id);
    grabs_.remove_if([&](const Grab& grab) { return grab.cloth == id; });
    for (std::size_t i = stitches_.size(); i-- > 0;) {
        const auto of_cloth = [&](const Stitch& stitch) { return stitch.a == id || stitch.b == id; };
        if (std::ranges::any_of(stitches_[i], of_cloth)) stitches_.remove(stitches_.id_of(i));
    }
    list_cloths();
    replan();
}

Result<void> World::set_pins(ClothId id, std::vector<std::uint32_t> pinned, KinematicTargets targets) {
    assert(contains(id));
    complete_and_resolve();
    Cloth& cloth = cloths_[cloths_.find(id)];
    std::ranges::sort(pinned);
    pinned.erase(std::unique(pinned.begin(), pinned.end()), pinned.end());
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
    const bool replanned = cloth.targets.particles.empty() != targets.particles.empty() || is_attached(cloth.targets) ||
                           is_attached(targets);
    cloth.targets = std::move(targets);
    cloth.motion_poses.resize((std::size_t{settings_.solver.substeps} + 1) * cloth.targets.motions.size());
    unread_ = true;
    if (replanned) replan();
    return {};
}

StitchId World::add(std::vector<Stitch> stitches) {
    complete_and_resolve();
    const StitchId id = stitches_.add(std::move(stitches));
    replan();
    return id;
}

void World::remove(StitchId id) {
    assert(contains(id));
    complete_and_resolve();
    stitches_.remove(id);
    replan();
}

Result<ColliderId> World::try_add(Collider collider) {
    complete_and_resolve();
    if (collider.body)
        if (auto able = can_move(body_count() + 1); !able) return able.errors();
    auto surface = make_surface(collider);
    if (!surface) return surface.errors();
    const ColliderId id = colliders_.add(std::move(collider));
    if (Collider& added = colliders_[colliders_.find(id)]; added.body) start_body(added);
    if (surface->model) {
        surface->collider = id;
        surfaces_.push_back(std::move(*surface));
    }
    places_->reset();
    replan();
    return id;
}

ColliderId World::add(Collider collider) {
    auto id = try_add(std::move(collider));
    if (!id) throw std::runtime_error(id.error().message());
    return *id;
}

void World::remove(ColliderId id) {
    assert(contains(id));
    complete_and_resolve();
    const Pose last = collider(id).pose;
    for (Cloth& cloth : cloths_) {
        for (std::uint32_t m = 0; m < cloth.targets.motions.size(); ++m) {
            if (cloth.targets.motions[m].collider != id) continue;
            cloth.targets.motions[m] = {};
            for (KinematicTarget& target : cloth.targets.particles) {
                if (target.motion == m) target.local = to_world(last, target.local);
            }
        }
    }
    remove_surface(id);
    colliders_.remove(id);
    places_->reset();
    replan();
}

void World::set_friction(ColliderId id, std::array<float, 2> friction) {
    assert(contains(id));
    complete();  // the running frame must keep its friction
    colliders_[colliders_.find(id)].friction = friction;
    if (Surface* const surface = surface_of(id)) {
        auto changed = with_friction(*surface->model, friction);
        if (backend_->set_material(surface->handle, changed)) surface->model = std::move(changed);
    }
}

void World::move(ColliderId id, const Pose& to) {
    assert(contains(id));
    Collider& collider = colliders_[colliders_.find(id)];
    collider.motion.clear();
    if (collider.body) return place_body(id, to, {}, {});
    collider.next_pose = to;
}

void World::configure(WorldSettings settings) {
    assert(settings.solver.substeps > 0 && settings.solver.iterations > 0);
    complete_and_resolve();
    settings_ = std::move(settings);
    if (!settings_.contact_forces) {
        contact_logs_ = {};
        contact_forces_ = {};
    }
    if (!settings_.contact_marks)
        for (ClothFrame& cloth : frame_.cloths) cloth.contact_marks.clear();
    replan();
}

void World::list_cloths() {
    frame_.cloths.resize(cloths_.size());
    for (std::size_t i = 0; i < cloths_.size(); ++i) {
        frame_.cloths[i].id = cloths_.id_of(i);
        frame_.cloths[i].model = cloths_[i].model.get();
        frame_.cloths[i].contact_marks.clear();
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
    const auto faces_touch_any = [&](const Cloth& cloth) {
        return std::ranges::any_of(colliders_, [&](const Collider& c) { return faces_touch(*cloth.model, c); });
    };
    const StepSettings settings{
        .solver = settings_.solver,
        .contacts = !colliders_.empty(),
        .faces = std::ranges::any_of(cloths_, faces_touch_any),
        .air = air,
        .wind = air && !settings_.air->wind.empty(),
        .adhesion = std::ranges::any_of(colliders_, [](const Collider& c) { return !!c.adhesion; }),
        .bodies = std::ranges::any_of(colliders_, [](const Collider& c) { return !!c.body; }),
        .surface = settings_.surface,
        .compensated = compensated_};
    const std::size_t places = std::size_t{settings_.solver.substeps} + 1;
    std::vector<PlannedCloth> planned, planned_surfaces;
    for (std::size_t i = 0; i < cloths_.size(); ++i) {
        Cloth& cloth = cloths_[i];
        planned.push_back(this->planned(i));
        if (settings_.solver.method == Method::pbd)
            cloth.stiffness = plain_stiffness(cloth.model->fabric, settings_.solver.iterations);
        cloth.motion_poses.resize(places * cloth.targets.motions.size());
    }
    winds_.resize(air ? settings_.air->wind.size() : 0);

    torn_.clear();
    make_islands();
    for (Surface& surface : surfaces_) surface.poses.resize(places);
    for (const Island& island : islands_)
        for (const std::uint32_t place : island.surfaces)
            planned_surfaces.push_back({surfaces_[place].model.get(), surfaces_[place].moves});
    planned.insert(planned.end(), planned_surfaces.begin(), planned_surfaces.end());
    std::vector<const LinkTables*> links;
    for (const Island& island : islands_)
        for (const auto& tables : island.links) links.push_back(tables.get());
    plan_ = plan_world(settings, planned, links);
    std::vector<PlannedCloth> members;
    for (Island& island : islands_) {
        members.clear(), links.clear();
        for (const std::uint32_t place : island.cloths) members.push_back(planned[place]);
        for (const std::uint32_t place : island.surfaces)
            members.push_back({surfaces_[place].model.get(), surfaces_[place].moves});
        for (const auto& tables : island.links) links.push_back(tables.get());
        island.plan = IslandPlan(plan_, members, links);
    }
    ++plan_serial_;
}

// Groups cloths that are stitched together to parts, and parts that can collide to islands. Packs the stitches of each
// part with particles numbered over the world.
void World::make_islands() {
    const auto place_of = [&](ClothId id) { return static_cast<std::uint32_t>(cloths_.find(id)); };
    std::vector<std::array<std::uint32_t, 2>> stitched;
    for (const auto& group : stitches_)
        for (const Stitch& stitch : group) stitched.push_back({place_of(stitch.a), place_of(stitch.b)});
    const auto parts = group_islands(static_cast<std::uint32_t>(cloths_.size()), stitched);
    std::vector<std::uint32_t> part_of(cloths_.size());
    for (std::uint32_t part = 0; part < parts.size(); ++part)
        for (const std::uint32_t place : parts[part]) part_of[place] = part;

    std::vector<std::vector<PlacedStitch>> placed(parts.size());
    const auto in_world = [&](StitchPoint point, ClothId id) {
        for (std::uint32_t& p : point.particles) p += cloths_[cloths_.find(id)].base;
        return point;
    };
    for (const auto& group : stitches_) {
        for (const Stitch& stitch : group)
            placed[part_of[place_of(stitch.a)]].push_back(
                {in_world(stitch.from, stitch.a), in_world(stitch.to, stitch.b), stitch.gap, stitch.compliance});
    }

    islands_.clear();
    const auto part_count = static_cast<std::uint32_t>(parts.size()),
               surface_count = static_cast<std::uint32_t>(surfaces_.size());
    for (const auto& members : group_islands(part_count + surface_count, colliding_parts(part_of, part_count))) {
        if (members.front() >= part_count) continue;  // nothing can touch this surface
        Island& island = islands_.emplace_back();
        std::vector<PlacedStitch> of_island;
        for (const std::uint32_t part : members) {
            if (part >= part_count) {
                const auto at = static_cast<std::uint32_t>(island.cloths.size() + island.surfaces.size());
                island.surfaces.push_back(part - part_count);
                island.parts.push_back({.begin = at, .end = at + 1});
                continue;
            }
            StitchedPart& mine = island.parts.emplace_back();
            mine.begin = static_cast<std::uint32_t>(island.cloths.size());
            island.cloths.insert(island.cloths.end(), parts[part].begin(), parts[part].end());
            mine.end = static_cast<std::uint32_t>(island.cloths.size());
            if (placed[part].empty()) continue;
            const Cloth& first = cloths_[parts[part].front()];
            island.links.push_back(std::make_unique<const LinkTables>(
                make_links(placed[part], first.base + first_dummy(first.model->room()))));
            mine.links = island.links.back().get();
            of_island.insert(of_island.end(), placed[part].begin(), placed[part].end());
        }
        island.seams = seams_of(island.cloths, of_island);
    }
}

// Few pairs of parts that suffice to group all parts whose cloths can collide. `part_of`: by cloth, < `parts`. Surfaces
// of colliders are numbered after the parts.
std::vector<std::array<std::uint32_t, 2>> World::colliding_parts(std::span<const std::uint32_t> part_of,
                                                                 std::uint32_t parts) const {
    std::vector<std::array<std::uint32_t, 2>> ties;
    // Any cloth may touch any body, so they step together.
    if (std::ranges::any_of(colliders_, [](const Collider& c) { return !!c.body; }))
        for (std::uint32_t part = 1; part < parts; ++part) ties.push_back({0, part});
    DisjointSets grouped(static_cast<std::uint32_t>(parts));
    for (std::uint32_t b = 0; b < cloths_.size(); ++b) {
        for (std::uint32_t a = 0; a < b; ++a) {
            const std::uint32_t one = part_of[a], two = part_of[b];
            if (!can_collide(cloths_[a].model->collision, cloths_[b].model->collision) ||
                grouped.first_of(one) == grouped.first_of(two))
                continue;
            grouped.merge(one, two);
            ties.push_back({one, two});
        }
    }
    for (std::uint32_t surface = 0; surface < surfaces_.size(); ++surface) {
        for (std::uint32_t cloth = 0; cloth < cloths_.size(); ++cloth)
            if (can_collide(surfaces_[surface].model->collision, cloths_[cloth].model->collision))
                ties.push_back({part_of[cloth], parts + surface});
    }
    return ties;
}

void World::place_motions(Cloth& cloth, double dt) const {
    const std::size_t count = cloth.targets.motions.size();
    for (std::size_t i = 0; i < count; ++i) {
        const TargetMotion& motion = cloth.targets.motions[i];
        const std::size_t collider = colliders_.find(motion.collider);
        for (std::uint32_t substep = 0; substep <= settings_.solver.substeps; ++substep) {
            const double time = frame_.time + dt * substep / settings_.solver.substeps;
            cloth.motion_poses[substep * count + i] = collider < colliders_.size()
                                                          ? places_->pose(collider, substep)
                                                          : Pose{{}, offset_at(motion.offsets, time)};
        }
    }
}

void World::advance(double dt) {
    assert(dt > 0 && std::isfinite(dt));
    complete();
    const bool compensated = compensates(settings_.solver, dt);
    if (compensated != std::exchange(compensated_, compensated) || !torn_.empty()) replan();
    while (const auto ready = pending_.take_due(frame_.index + 1)) use_model(*ready);
    if (settings_.background) pending_.start_next();
    begin_surfaces();
    if (watched_serial_ != plan_serial_) watch_tangle();
    watched_serial_ = plan_serial_;
    const auto begin = std::chrono::steady_clock::now();
    places_->begin_frame(colliders_.values(), frame_.time, dt, settings_.solver.substeps);
    for (Cloth& cloth : cloths_) place_motions(cloth, dt);
    begin_grabs();
    begin_bodies();
    place_surfaces();
    for (std::size_t i = 0; i < winds_.size(); ++i) {
        winds_[i] = wind_at(settings_.air->wind[i], frame_.time + 0.5 * dt);
    }
    frame_.index += 1;
    frame_.time += dt;
    frame_.reports = report_none;
    frame_.stage_ms.fill(0);
    ContactLog& contact_log = begin_contact_forces(dt);
    steps_.clear();
    for (Island& island : islands_) {
        island.steps.clear();
        for (const std::uint32_t place : island.cloths) {
            Cloth& cloth = cloths_[place];
            island.steps.push_back(
                {.cloth = cloth.handle,
                 .stiffness = &cloth.stiffness,
                 .targets = cloth.targets.particles,
                 .motion_poses = cloth.motion_poses,
                 .motions = static_cast<std::uint32_t>(cloth.targets.motions.size()),
                 .motion_bodies = cloth.motion_bodies,
                 .grabs = cloth.grabs,
                 .pulls = cloth.pulls,
                 .frame = &frame_.cloths[place],
                 .contact_forces = settings_.contact_forces ? &contact_log.cloths[place].contact_forces : nullptr});
        }
        for (const std::uint32_t place : island.surfaces) island.steps.push_back(step_of(surfaces_[place]));
        steps_.push_back({.plan = &island.plan, .cloths = island.steps, .parts = island.parts, .seams = island.seams});
    }
    step_ = {.plan = &plan_,
             .plan_serial = plan_serial_,
             .input = {.dt = dt,
                       .gravity = settings_.gravity,
                       .air_density = settings_.air ? settings_.air->density : 0,
                       .winds = winds_,
                       .colliders = colliders_.values(),
                       .places = places_.get(),
                       .bodies = bodies_,
                       .contact_forces = settings_.contact_forces,
                       .contact_marks = settings_.contact_marks,
                       .list_capacity = settings_.list_capacity,
                       .tangle = tangle_.tangle(),
                       .surface_motion = surface_motion()},
             .islands = steps_};
    backend_->step(step_);
    running_ = true;
    for (std::size_t i = 0; i < colliders_.size(); ++i) {
        if (!colliders_[i].body) colliders_[i].pose = places_->end_pose(i);
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
    frame_.cloth_contacts = backend_->cloth_contact_counts();
    unread_ = true;
    if (tangle_.tangle() || frame_.cloth_contacts.tangled > 0) watch_tangle();
    tangle_.count(frame_.cloth_contacts);
    if (settings_.contact_marks) collect_contact_marks();
    end_bodies();
    read_grabs();
    take_openings();
    frame_.tangled_at = place_of(frame_.cloth_contacts.tangled_particle);
    for (const ClothFrame& cloth : frame_.cloths) frame_.reports |= cloth.reports;
    if (settings_.contact_forces) unresolved_ = static_cast<std::uint32_t>(frame_.index % contact_logs_.size());
    frame_.step_ms += ms_since(begin);
}

// Lists the cloths and colliders of the new frame in its contact log.
ContactLog& World::begin_contact_forces(double dt) {
    ContactLog& contact_log = contact_logs_[frame_.index % contact_logs_.size()];
    if (!settings_.contact_forces) return contact_log;
    contact_log.frame = frame_.index;
    contact_log.dt = dt;
    contact_log.colliders.clear();
    for (std::size_t i = 0; i < colliders_.size(); ++i) contact_log.colliders.push_back(colliders_.id_of(i));
    contact_log.cloths.resize(cloths_.size());
    for (std::size_t i = 0; i < cloths_.size(); ++i) {
        contact_log.cloths[i].id = cloths_.id_of(i);
        contact_log.cloths[i].model = cloths_[i].model;
        contact_log.cloths[i].contact_forces.contacts = {};
        contact_log.cloths[i].contact_forces.sums.assign(colliders_.size(), {});
    }
    return contact_log;
}

const ContactForces& World::contact_forces() const {
    if (unresolved_) resolve(contact_logs_[*unresolved_], contact_forces_, vertices_);
    unresolved_.reset();
    return contact_forces_;
}

void World::complete_and_resolve() {
    complete();
    (void)contact_forces();
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
    hash_grabs(hash);
    hash_bodies(hash);
    return hash.text();
}

}  // namespace weft
