// The part of World that replaces the models of cloths.
#include "solver/plan/world_plan.h"
#include "solver/world/world.h"

#include <algorithm>
#include <cassert>

namespace weft {
namespace {

// The snapshot of a cloth, for a model of the same particles with another reserve.
ClothSnapshot with_other_room(const ClothSnapshot& before, const ClothModel& from, const ClothModel& to) {
    ClothSnapshot after;
    after.kept = kept_after(from, before.kept, to), after.substep_seconds = before.substep_seconds;
    const bool same_anchors = from.anchor_count == to.anchor_count;
    const auto moved = [&](const std::vector<Vec4>& points, bool places) {
        std::vector<Vec4> all(to.point_count());
        if (places) std::copy_n(to.start.begin(), all.size(), all.begin());
        std::copy_n(points.begin(), to.particle_count, all.begin());
        if (same_anchors)
            std::copy_n(points.begin() + from.first_anchor(), to.anchor_count, all.begin() + to.first_anchor());
        return all;
    };
    after.position = moved(before.position, true), after.start = moved(before.start, true);
    after.velocity = moved(before.velocity, false), after.compensation = moved(before.compensation, false);
    for (std::uint32_t p = 0; p < to.point_count(); ++p) after.position[p].w = to.start[p].w;
    return after;
}

}  // namespace

Result<void> World::exchange_model(Cloth& cloth, std::shared_ptr<const ClothModel> model,
                                   std::optional<std::vector<std::uint32_t>> pinned) {
    assert(model->first_anchor() == cloth.model->first_anchor() && model->copied_from.empty());
    std::shared_ptr<const ClothModel> unedited;
    std::vector<ClothEdit> edits;
    if (!cloth.edits.empty() && model->tears && has_only_openings(cloth)) {
        unedited = model;
        edits.push_back(all_openings(cloth));
        auto opened = with_openings(*model, edits.front().openings, pinned ? *pinned : pinned_particles(*model));
        if (!opened) return opened.errors();
        model = std::move(*opened);
    }
    const std::uint32_t before = cloth.model->capacity(), after = model->capacity();
    const std::uint32_t base = after == before ? cloth.base : space_.take(after);
    if (auto set = backend_->set_model(cloth.handle, model, base); !set) {
        if (base != cloth.base) space_.give_back(base, after);
        return set;
    }
    if (base != cloth.base) space_.give_back(cloth.base, before);
    cloth.base = base;
    cloth.model = std::move(model);
    cloth.unedited = std::move(unedited);
    cloth.edits = std::move(edits);
    cloth.pinned = pinned_particles(*cloth.model);
    return {};
}

Result<void> World::set_model(ClothId id, std::shared_ptr<const ClothModel> model, KinematicTargets targets,
                              std::optional<std::vector<std::uint32_t>> pinned) {
    assert(contains(id));
    complete_and_resolve();
    pending_.drop(id);
    Cloth& cloth = cloths_[cloths_.find(id)];
    if (auto set = exchange_model(cloth, std::move(model), std::move(pinned)); !set) return set;
    cloth.targets = std::move(targets);
    list_cloths();
    replan();
    return {};
}

Result<void> World::set_model_with_room(ClothId id, std::shared_ptr<const ClothModel> model, KinematicTargets targets) {
    assert(contains(id));
    complete_and_resolve();
    pending_.drop(id);
    Cloth& cloth = cloths_[cloths_.find(id)];
    assert(cloth.edits.empty() && model->particle_count == cloth.model->particle_count);
    const std::uint32_t base = space_.take(model->capacity());
    const auto handle = backend_->add_cloth(model, base);
    Result<void> set =
        handle ? backend_->restore(*handle, with_other_room(backend_->save(cloth.handle), *cloth.model, *model))
               : Result<void>(handle.errors());
    if (!set) {
        if (handle) backend_->remove_cloth(*handle);
        space_.give_back(base, model->capacity());
        return set;
    }
    backend_->remove_cloth(cloth.handle);
    space_.give_back(cloth.base, cloth.model->capacity());
    cloth.handle = *handle;
    cloth.base = base;
    cloth.pinned = pinned_particles(*model);
    cloth.model = std::move(model);
    cloth.targets = std::move(targets);
    list_cloths();
    replan();
    return {};
}

Result<void> World::set_material(ClothId id, std::shared_ptr<const ClothModel> model) {
    assert(contains(id));
    complete_and_resolve();
    Cloth& cloth = cloths_[cloths_.find(id)];
    auto unedited = with_fabric_unedited(cloth, *model);
    if (!unedited) return unedited.errors();
    if (auto set = backend_->set_material(cloth.handle, model); !set) return set;
    pending_.drop(id);
    cloth.unedited = std::move(*unedited);
    // Plans depend on the fabric only by whether it damps, and by how thick it is beside seams.
    const Fabric &before = cloth.model->fabric, &after = model->fabric;
    const bool same_plan = (before.body.damping > 0) == (after.body.damping > 0) &&
                           (stitches_.empty() || before.contact.thickness == after.contact.thickness);
    cloth.model = std::move(model);
    if (settings_.solver.method == Method::pbd)
        cloth.stiffness = plain_stiffness(cloth.model->fabric, settings_.solver.iterations);
    list_cloths();
    if (!same_plan) replan();
    return {};
}

void World::rebuild_later(ClothId id, BuildModel build) {
    assert(contains(id));
    if (!has_only_openings(cloths_[cloths_.find(id)])) return;
    const std::uint64_t due = frame_.index + frames_to_build(model(id)->particle_count);
    pending_.add(id, due, std::move(build));
}

// If the model cannot be built or the device has not enough memory, the cloth keeps its model and continues.
void World::use_model(const PendingModels::Ready& ready) {
    complete_and_resolve();
    if (!ready.model) return;
    Cloth& cloth = cloths_[cloths_.find(ready.cloth)];
    if (!has_only_openings(cloth) || !exchange_model(cloth, *ready.model, cloth.pinned)) return;
    list_cloths();
    replan();
}

}  // namespace weft
