// The part of World that saves and restores its state.
#include "solver/world/world.h"

namespace weft {

Snapshot World::save() {
    complete();
    while (const auto ready = pending_.take_any()) use_model(*ready);
    return snapshot();
}

Snapshot World::snapshot() {
    complete();
    Snapshot snapshot{.frame = frame_.index, .time = frame_.time, .cloths = {}, .colliders = {}, .grabs = save_grabs()};
    for (const Cloth& cloth : cloths_) {
        snapshot.cloths.push_back(backend_->save(cloth.handle));
        snapshot.cloths.back().targets = save_targets(cloth.targets);
        snapshot.cloths.back().edits = cloth.edits;
    }
    for (const Collider& collider : colliders_) snapshot.colliders.push_back(collider.pose);
    snapshot.bodies = save_bodies();
    return snapshot;
}

SavedTargets World::save_targets(const KinematicTargets& targets) const {
    SavedTargets saved;
    saved.particles = targets.particles;
    for (const TargetMotion& motion : targets.motions) {
        const std::size_t place = colliders_.find(motion.collider);
        saved.motions.push_back({place < colliders_.size() ? static_cast<std::uint32_t>(place) : none, motion.offsets});
    }
    return saved;
}

KinematicTargets World::restore_targets(const SavedTargets& saved) const {
    KinematicTargets targets;
    targets.particles = saved.particles;
    for (const SavedMotion& motion : saved.motions)
        targets.motions.push_back(
            {motion.collider == none ? ColliderId{} : colliders_.id_of(motion.collider), motion.offsets});
    return targets;
}

Result<void> World::check_fits(const Snapshot& snapshot) const {
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
        const std::size_t kept = cloths_[i].model->kept_floats();
        const std::string of_cloth = "particles in cloth '" + cloths_[i].model->name + "'";
        for (const auto* array : {&saved.position, &saved.start, &saved.velocity, &saved.compensation}) {
            if (array->size() != points) return differs(of_cloth.c_str(), array->size(), points);
        }
        if (saved.kept.size() != kept) return differs("numbers of constraints", saved.kept.size(), kept);
        for (const SavedMotion& motion : saved.targets.motions) {
            if (motion.collider != none && motion.collider >= colliders_.size())
                return differs("colliders of pins", motion.collider + std::size_t{1}, colliders_.size());
        }
        for (const KinematicTarget& target : saved.targets.particles) {
            if (target.particle >= points || target.motion >= saved.targets.motions.size())
                return Error{"state", "holds particle " + std::to_string(target.particle) + " of cloth '" +
                                          cloths_[i].model->name + "', which it has not"};
        }
    }
    return check_numbers(snapshot);
}

// All of them or none. Only cloths with other edits need memory on the device.
Result<void> World::restore_cloths(const Snapshot& snapshot,
                                   std::span<const std::shared_ptr<const ClothModel>> models) {
    const auto has_other_edits = [&](std::size_t i) { return snapshot.cloths[i].edits != cloths_[i].edits; };
    Snapshot before;
    std::vector<std::shared_ptr<const ClothModel>> models_before;
    for (std::size_t i = 0; i < cloths_.size(); ++i) {
        if (before.cloths.empty() && has_other_edits(i)) before = this->snapshot();
        models_before.push_back(cloths_[i].model);
    }
    for (std::size_t i = 0; i < cloths_.size(); ++i) {
        auto restored = restore_cloth(cloths_[i], snapshot.cloths[i], models[i]);
        if (restored) continue;
        for (std::size_t k = 0; k < i && !before.cloths.empty(); ++k)
            (void)restore_cloth(cloths_[k], before.cloths[k], models_before[k]);
        return restored;
    }
    return {};
}

Result<void> World::restore_cloth(Cloth& cloth, const ClothSnapshot& snapshot,
                                  const std::shared_ptr<const ClothModel>& model) {
    if (auto set = set_edits(cloth, snapshot.edits, model); !set) return set;
    if (auto restored = backend_->restore(cloth.handle, snapshot); !restored) return restored;
    cloth.targets = restore_targets(snapshot.targets);
    cloth.pinned.clear();
    for (std::uint32_t p = 0; p < cloth.model->particle_count; ++p)
        if (!(snapshot.position[p].w > 0)) cloth.pinned.push_back(p);
    return {};
}

Result<void> World::restore(const Snapshot& snapshot) {
    complete();
    while (const auto ready = pending_.take_any()) use_model(*ready);
    return bring_back(snapshot);
}

Result<void> World::bring_back(const Snapshot& snapshot) {
    if (auto fits = check_fits(snapshot); !fits) return fits;
    std::vector<std::shared_ptr<const ClothModel>> edited;
    for (std::size_t i = 0; i < cloths_.size(); ++i) {
        auto model = edited_model(cloths_[i], snapshot.cloths[i].edits);
        if (!model) return model.errors();
        edited.push_back(std::move(*model));
    }
    if (auto found = check_grabs(snapshot, edited); !found) return found;
    if (auto found = check_bodies(snapshot); !found) return found;
    if (auto restored = restore_cloths(snapshot, edited); !restored) return restored;
    restore_grabs(snapshot.grabs);
    places_->reset();
    for (std::size_t i = 0; i < colliders_.size(); ++i) {
        colliders_[i].pose = snapshot.colliders[i];
        colliders_[i].next_pose.reset();
    }
    restore_bodies(snapshot.bodies);
    put_surfaces();
    frame_.index = snapshot.frame;
    frame_.time = snapshot.time;
    frame_.reports = report_none;
    unresolved_.reset();
    contact_forces_ = {};
    list_cloths();
    replan();
    return {};
}

}  // namespace weft
