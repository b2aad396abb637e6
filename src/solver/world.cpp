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

ClothId World::add(std::shared_ptr<const ClothModel> model) {
    const ClothId id = backend_->add_cloth(model);
    cloths_.push_back({id, std::move(model), {}});
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
    const StepSettings settings{settings_.substeps, settings_.iterations, !colliders_.empty(), settings_.surface};
    for (Cloth& cloth : cloths_) cloth.plan = plan_step(*cloth.model, settings);
    poses_.resize((std::size_t{settings_.substeps} + 1) * colliders_.size());
}

const Frame& World::step(double dt) {
    assert(dt > 0 && std::isfinite(dt));
    for (std::size_t i = 0; i < poses_.size(); ++i) poses_[i] = colliders_[i % colliders_.size()].pose;
    const StepInput input{dt, settings_.gravity, colliders_, poses_};

    const auto begin = std::chrono::steady_clock::now();
    frame_.index += 1;
    frame_.time += dt;
    frame_.reports = report_none;
    frame_.stage_ms.fill(0);
    for (std::size_t i = 0; i < cloths_.size(); ++i) {
        backend_->step(cloths_[i].id, cloths_[i].plan, input, frame_.cloths[i], frame_.stage_ms);
        frame_.reports |= frame_.cloths[i].reports;
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
