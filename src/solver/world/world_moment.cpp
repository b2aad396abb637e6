// The part of World that goes back to an earlier moment.
#include "solver/world/world_moment.h"

#include "solver/world/world.h"

#include <cassert>
#include <utility>

namespace weft {

WorldMoment World::moment() {
    WorldMoment moment{.state = snapshot(),
                       .cloths = {},
                       .models = {},
                       .colliders = colliders_.values(),
                       .settings = settings_,
                       .pending = pending_};
    for (std::size_t i = 0; i < cloths_.size(); ++i) {
        moment.cloths.push_back(cloths_.id_of(i));
        moment.models.push_back(cloths_[i].unedited ? cloths_[i].unedited : cloths_[i].model);
    }
    return moment;
}

Result<void> World::go_to(const WorldMoment& moment) {
    assert(moment.models.size() == cloths_.size() && moment.colliders.size() == colliders_.size());
    complete_and_resolve();
    pending_ = {};
    // What is recorded, and where models are built, belongs to the program and not to the world.
    const WorldSettings now = std::exchange(settings_, moment.settings);
    settings_.contact_forces = now.contact_forces;
    settings_.contact_marks = now.contact_marks;
    settings_.background = now.background;
    for (std::size_t i = 0; i < colliders_.size(); ++i) {
        const ColliderId id = colliders_.id_of(i);
        if (colliders_[i].friction != moment.colliders[i].friction) set_friction(id, moment.colliders[i].friction);
        colliders_[i].name = moment.colliders[i].name;
        colliders_[i].motion = moment.colliders[i].motion;
        colliders_[i].adhesion = moment.colliders[i].adhesion;
        colliders_[i].body = moment.colliders[i].body;
    }
    for (std::size_t i = 0; i < cloths_.size(); ++i) {
        Cloth& cloth = cloths_[i];
        if ((cloth.unedited ? cloth.unedited : cloth.model) == moment.models[i]) continue;
        cloth.edits.clear();  // the snapshot has those of the moment
        if (auto set = exchange_model(cloth, moment.models[i], {}); !set) return set;
    }
    if (auto back = bring_back(moment.state); !back) return back;
    for (std::size_t i = 0; i < colliders_.size(); ++i) colliders_[i].next_pose = moment.colliders[i].next_pose;
    pending_ = moment.pending;
    for (std::size_t i = 0; i < cloths_.size(); ++i) pending_.rename(moment.cloths[i], cloths_.id_of(i));
    return {};
}

void World::reorder(std::span<const ClothId> cloths, std::span<const ColliderId> colliders) {
    complete_and_resolve();
    cloths_.reorder(cloths);
    colliders_.reorder(colliders);
    places_->reset();
    contact_forces_ = {};
    list_cloths();
    replan();
}

std::size_t size_of(const WorldMoment& moment) {
    std::size_t bytes = sizeof moment + moment.colliders.size() * sizeof(Collider);
    for (const ClothSnapshot& cloth : moment.state.cloths) {
        for (const auto* array : {&cloth.position, &cloth.start, &cloth.velocity, &cloth.compensation})
            bytes += array->size() * sizeof(Vec4);
        bytes += cloth.kept.size() * sizeof(float) + cloth.targets.particles.size() * sizeof(KinematicTarget);
        for (const ClothEdit& edit : cloth.edits) bytes += edit.openings.size() * sizeof(Opening);
    }
    return bytes;
}

}  // namespace weft
