#include "view/world_frame.h"

#include <mutex>
#include <utility>

namespace weft {

void WorldFrameCopy::take(const World& world) {
    frame_ = world.frame();  // first, because it completes a tear, and then models are those of the frame
    const std::size_t cloths = world.cloth_count(), colliders = world.colliders().size();
    models_.resize(cloths);
    arrays_.resize(cloths);
    targets_.resize(cloths);
    cloth_places_.clear();
    for (std::size_t i = 0; i < cloths; ++i) {
        const ClothId id = world.cloth_id(i);
        ClothFrame& cloth = frame_.cloths[i];
        models_[i] = world.model(id);
        arrays_[i].positions.assign(cloth.positions.begin(), cloth.positions.end());
        arrays_[i].normals.assign(cloth.normals.begin(), cloth.normals.end());
        cloth.positions = arrays_[i].positions;
        cloth.normals = arrays_[i].normals;
        cloth.velocities = {};
        cloth.model = models_[i].get();
        targets_[i] = world.kinematic_targets(id);
        cloth_places_.add(id, i);
    }
    colliders_ = world.colliders();
    collider_ids_.clear();
    collider_places_.clear();
    for (std::size_t i = 0; i < colliders; ++i) {
        collider_ids_.push_back(world.collider_id(i));
        collider_places_.add(collider_ids_.back(), i);
    }
    contact_forces_ = world.contact_forces();
    air_ = world.settings().air;
}

void WorldFrameCopy::let_go() {
    models_.clear();
    colliders_.clear();
}

struct WorldFrameCopies::Unused {
    static constexpr std::size_t most = 3;  // as many as are in use at once: drawn, waiting and made

    std::unique_ptr<WorldFrameCopy> take() {
        const std::lock_guard lock(mutex);
        if (copies.empty()) return {};
        auto last = std::move(copies.back());
        copies.pop_back();
        return last;
    }
    void give(std::unique_ptr<WorldFrameCopy> copy) {
        copy->let_go();
        const std::lock_guard lock(mutex);
        if (copies.size() < most) copies.push_back(std::move(copy));
    }

    std::mutex mutex;
    std::vector<std::unique_ptr<WorldFrameCopy>> copies;
};

WorldFrameCopies::WorldFrameCopies() : unused_(std::make_shared<Unused>()) {}

std::shared_ptr<const WorldFrameCopy> WorldFrameCopies::copy(const World& world) {
    std::unique_ptr<WorldFrameCopy> made = unused_->take();
    if (!made) made.reset(new WorldFrameCopy);
    made->take(world);
    return {made.release(), [unused = unused_](const WorldFrameCopy* copy) {
                unused->give(std::unique_ptr<WorldFrameCopy>(const_cast<WorldFrameCopy*>(copy)));
            }};
}

}  // namespace weft
