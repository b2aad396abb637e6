#include "solver/world.h"

#include "base/hash.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cmath>

namespace weft {

World::World(std::unique_ptr<Backend> backend, const WorldSettings& settings)
    : backend_(std::move(backend)), settings_(settings) {
    assert(settings_.substeps > 0 && settings_.iterations > 0);
}

ClothId World::add(std::shared_ptr<const ClothModel> model, Holds holds) {
    const ClothId id = backend_->add_cloth(model);
    cloths_.push_back({id, std::move(model), std::move(holds), {}, {}});
    frame_.cloths.emplace_back();
    backend_->read(id, frame_.cloths.back());
    replan();
    return id;
}

void World::add(Collider collider) {
    colliders_.push_back(std::move(collider));
    replan();
}

void World::replan() {
    StepSettings settings{.substeps = settings_.substeps,
                          .iterations = settings_.iterations,
                          .contacts = !colliders_.empty(),
                          .holds = false,
                          .surface = settings_.surface};
    const std::size_t places = std::size_t{settings_.substeps} + 1;
    for (Cloth& cloth : cloths_) {
        settings.holds = !cloth.holds.particles.empty();
        cloth.plan = plan_step(*cloth.model, settings);
        cloth.mover_poses.resize(places * cloth.holds.movers.size());
    }
    poses_.resize(places * colliders_.size());
}

// Where every collider is at the start of the frame and after each substep.
void World::place_colliders(double dt) {
    const std::size_t count = colliders_.size();
    for (std::uint32_t substep = 0; substep <= settings_.substeps; ++substep) {
        const double time = frame_.time + dt * substep / settings_.substeps;
        for (std::size_t i = 0; i < count; ++i) poses_[substep * count + i] = pose_at(colliders_[i], time);
    }
}

void World::place_movers(Cloth& cloth, double dt) const {
    const std::size_t count = cloth.holds.movers.size();
    for (std::uint32_t substep = 0; substep <= settings_.substeps; ++substep) {
        const double time = frame_.time + dt * substep / settings_.substeps;
        for (std::size_t i = 0; i < count; ++i) {
            const Mover& mover = cloth.holds.movers[i];
            cloth.mover_poses[substep * count + i] = mover.collider != none
                                                         ? poses_[substep * colliders_.size() + mover.collider]
                                                         : Pose{{}, offset_at(mover.offsets, time)};
        }
    }
}

const Frame& World::step(double dt) {
    assert(dt > 0 && std::isfinite(dt));
    place_colliders(dt);
    for (Cloth& cloth : cloths_) place_movers(cloth, dt);
    const auto begin = std::chrono::steady_clock::now();
    frame_.index += 1;
    frame_.time += dt;
    frame_.reports = report_none;
    frame_.stage_ms.fill(0);
    for (std::size_t i = 0; i < cloths_.size(); ++i) {
        const Cloth& cloth = cloths_[i];
        const StepInput input{.dt = dt,
                              .gravity = settings_.gravity,
                              .colliders = colliders_,
                              .poses = poses_,
                              .held = cloth.holds.particles,
                              .mover_poses = cloth.mover_poses,
                              .movers = static_cast<std::uint32_t>(cloth.holds.movers.size())};
        backend_->step(cloth.id, cloth.plan, input, frame_.cloths[i], frame_.stage_ms);
        frame_.reports |= frame_.cloths[i].reports;
    }
    for (std::size_t i = 0; i < colliders_.size(); ++i) {
        colliders_[i].pose = poses_[settings_.substeps * colliders_.size() + i];
    }
    frame_.step_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
    return frame_;
}

Residual World::stretch_residual() const {
    Residual all;
    double rows = 0;
    for (const Cloth& cloth : cloths_) {
        const double count = cloth.model->table(ConstraintKind::stretch).rows;
        const Residual one = backend_->stretch_residual(cloth.id);
        all.mean += one.mean * count;
        all.max = std::max(all.max, one.max);
        rows += count;
    }
    if (rows > 0) all.mean /= rows;
    return all;
}

std::string World::state_hash() const {
    StateHash hash;
    for (const Cloth& cloth : cloths_) backend_->hash(cloth.id, hash);
    return hash.text();
}

}  // namespace weft
