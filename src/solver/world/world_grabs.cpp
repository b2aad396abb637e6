// Grabs: pulling cloths at points.
#include "base/hash.h"
#include "solver/world/world.h"

#include <algorithm>
#include <cassert>

namespace weft {
namespace {

// Removed triangles have three equal corners.
bool is_alive(const ClothModel& model, std::uint32_t triangle) {
    if (triangle >= model.triangle_count) return false;
    const Triangle corners = model.triangles()[triangle];
    return corners[0] != corners[1];
}

}  // namespace

bool World::is_grabbed(ClothId id) const {
    return std::ranges::find(grabs_, id, &Grab::cloth) != grabs_.end();
}

GrabId World::grab(ClothId cloth, std::uint32_t triangle, Vec3 weights, Vec3 to, const GrabDesc& spring) {
    assert(contains(cloth) && is_alive(*model(cloth), triangle) && spring.max_force > 0);
    complete_and_resolve();
    const bool replanned = !is_grabbed(cloth);
    const GrabId id =
        grabs_.add(cloth, {.triangle = triangle, .weights = weights, .from = to, .to = to, .spring = spring});
    if (replanned) replan();
    return id;
}

void World::move_grab(GrabId id, Vec3 to) {
    assert(knows(id));
    grabs_[id].step.to = to;
}

void World::release(GrabId id) {
    assert(contains(id));
    complete_and_resolve();
    const ClothId cloth = grabs_[id].cloth;
    grabs_.remove_if([&](const Grab& grab) { return grab.id == id; });
    if (!is_grabbed(cloth)) replan();
}

Vec3 World::grab_position(GrabId id) const {
    const Grab& grab = grabs()[id];
    const ClothFrame& cloth = frame().cloths[cloths_.find(grab.cloth)];
    const Triangle corners = cloth.model->triangles()[grab.step.triangle];
    const Vec3 weights = grab.step.weights;
    return cloth.positions[corners[0]].xyz() * weights.x + cloth.positions[corners[1]].xyz() * weights.y +
           cloth.positions[corners[2]].xyz() * weights.z;
}

// Lists the grabs of each cloth for the next frame. Their targets stay at its end.
void World::begin_grabs() {
    if (grabs_.empty()) return;
    for (Cloth& cloth : cloths_) cloth.grabs.clear();
    for (Grab& grab : grabs_) {
        cloths_[cloths_.find(grab.cloth)].grabs.push_back(grab.step);
        grab.step.from = grab.step.to;
    }
    for (Cloth& cloth : cloths_) cloth.pulls.assign(cloth.grabs.size() * settings_.solver.substeps, {});
}

// The mean over the substeps.
void World::read_grabs() const {
    if (grabs_.empty()) return;
    std::vector<std::size_t> seen(cloths_.size(), 0);  // grabs of the cloth so far
    for (Grab& grab : grabs_) {
        const std::size_t place = cloths_.find(grab.cloth), number = seen[place]++;
        const Cloth& cloth = cloths_[place];
        const double h = step_.input.dt / settings_.solver.substeps;
        double sum[3] = {0, 0, 0};
        for (std::size_t i = number; i < cloth.pulls.size(); i += cloth.grabs.size())
            sum[0] += cloth.pulls[i].x, sum[1] += cloth.pulls[i].y, sum[2] += cloth.pulls[i].z;
        const bool taken_back = frame_.cloths[place].reports & (report_non_finite | report_device_failed);
        const double per = taken_back ? 0 : 1 / (h * h * settings_.solver.substeps);
        grab.force = {static_cast<float>(sum[0] * per), static_cast<float>(sum[1] * per),
                      static_cast<float>(sum[2] * per)};
    }
}

void World::drop_grabs_without_triangle() const {
    grabs_.remove_if(
        [&](const Grab& grab) { return !is_alive(*cloths_[cloths_.find(grab.cloth)].model, grab.step.triangle); });
}

void World::hash_grabs(StateHash& hash) const {
    for (const Grab& grab : grabs_) {
        const GrabStep& step = grab.step;
        hash.add(static_cast<std::uint32_t>(cloths_.find(grab.cloth))), hash.add(step.triangle);
        for (const Vec3& v : {step.weights, step.from, step.to}) hash.add(v.x), hash.add(v.y), hash.add(v.z);
        hash.add(step.spring.max_force), hash.add(step.spring.compliance), hash.add(step.spring.damping);
    }
}

std::vector<SavedGrab> World::save_grabs() const {
    std::vector<SavedGrab> saved;
    for (const Grab& grab : grabs_)
        saved.push_back(
            {.id = grab.id.index, .cloth = static_cast<std::uint32_t>(cloths_.find(grab.cloth)), .step = grab.step});
    return saved;
}

Result<void> World::check_grabs(const Snapshot& snapshot,
                                std::span<const std::shared_ptr<const ClothModel>> models) const {
    for (const SavedGrab& grab : snapshot.grabs) {
        if (grab.cloth >= cloths_.size() || !is_alive(*models[grab.cloth], grab.step.triangle))
            return Error{"state", "grabs triangle " + std::to_string(grab.step.triangle) + " of cloth " +
                                      std::to_string(grab.cloth) + ", which it has not"};
    }
    return {};
}

void World::restore_grabs(const std::vector<SavedGrab>& saved) {
    grabs_.remove_if([](const Grab&) { return true; });
    for (const SavedGrab& grab : saved)
        grabs_.restore({.id = {grab.id, 1}, .cloth = cloths_.id_of(grab.cloth), .step = grab.step, .force = {}});
}

}  // namespace weft
