// The part of SceneWorld that goes back to an earlier moment.
#include "weft/checkpoint.h"

#include "weft/scene_world.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace weft {
namespace {

// The first place where the lists differ. Objects from there on are made again, so that the world has their order.
std::size_t first_difference(std::span<const std::uint64_t> now, std::span<const std::uint64_t> then) {
    return static_cast<std::size_t>(std::ranges::mismatch(now, then).in1 - now.begin());
}

std::vector<std::uint64_t> serials_of(std::span<const ClothSource> sources) {
    std::vector<std::uint64_t> serials;
    for (const ClothSource& source : sources) serials.push_back(source.serial);
    return serials;
}

bool same_names(const SceneDesc& a, const SceneDesc& b) {
    return std::ranges::equal(a.cloths, b.cloths, {}, &SceneCloth::name, &SceneCloth::name) &&
           std::ranges::equal(a.colliders, b.colliders, {}, &SceneCollider::name, &SceneCollider::name);
}

/// Both must have as many cloths and colliders.
void take_names(SceneDesc& scene, const SceneDesc& from) {
    for (std::size_t i = 0; i < scene.cloths.size(); ++i) scene.cloths[i].name = from.cloths[i].name;
    for (std::size_t i = 0; i < scene.colliders.size(); ++i) scene.colliders[i].name = from.colliders[i].name;
}

}  // namespace

Checkpoint SceneWorld::checkpoint() {
    if (!checked_document_ || *checked_document_ != scene_)
        checked_document_ = std::make_shared<const SceneDesc>(scene_);
    return {checked_document_, sources_, collider_serials_, world_->moment()};
}

Result<void> SceneWorld::go_to(const Checkpoint& checkpoint) {
    const bool same_objects =
        serials_of(sources_) == serials_of(checkpoint.sources) && collider_serials_ == checkpoint.collider_serials;
    std::optional<Checkpoint> before;
    if (!same_objects || !same_names(scene_, *checkpoint.scene)) before = this->checkpoint();
    auto gone = match_objects(checkpoint);
    if (gone) take_names(scene_, *checkpoint.scene);  // stitches name cloths
    if (gone) gone = match_stitches(*checkpoint.scene, !same_objects);
    if (gone) gone = world_->go_to(checkpoint.moment);
    if (!gone) {
        if (before) (void)go_to(*before);  // fitted before
        return gone;
    }
    scene_ = *checkpoint.scene;
    sources_ = checkpoint.sources;
    checked_document_ = checkpoint.scene;
    return {};
}

// Removes objects that the checkpoint does not have, and adds those that are missing, with their models of then.
Result<void> SceneWorld::match_objects(const Checkpoint& checkpoint) {
    const WorldMoment& moment = checkpoint.moment;
    const std::size_t cloth = first_difference(serials_of(sources_), serials_of(checkpoint.sources));
    const std::size_t collider = first_difference(collider_serials_, checkpoint.collider_serials);
    while (sources_.size() > cloth) remove(world_->cloth_id(sources_.size() - 1));
    while (collider_serials_.size() > collider) remove(world_->collider_id(collider_serials_.size() - 1));
    for (std::size_t i = collider; i < moment.colliders.size(); ++i) {
        auto added = world_->try_add(moment.colliders[i]);
        if (!added) return added.errors();
        scene_.colliders.push_back(checkpoint.scene->colliders[i]);
        collider_serials_.push_back(checkpoint.collider_serials[i]);
    }
    for (std::size_t i = cloth; i < moment.models.size(); ++i) {
        auto added = world_->try_add(moment.models[i]);
        if (!added) return added.errors();
        scene_.cloths.push_back(checkpoint.scene->cloths[i]);
        sources_.push_back(checkpoint.sources[i]);
    }
    return {};
}

// `all`: makes all of them again, because the cloths that they tie may be new.
Result<void> SceneWorld::match_stitches(const SceneDesc& scene, bool all) {
    if (!all && scene_.stitches == scene.stitches) return {};
    while (!stitch_ids_.empty()) remove(stitch_ids_.back());
    for (std::size_t i = 0; i < scene.stitches.size(); ++i)
        if (auto added = add(scene.stitches[i], "/stitches/" + std::to_string(i)); !added) return added.errors();
    return {};
}

// Models that are being built have the old names, so this waits for them.
Result<void> SceneWorld::rename(const SceneDesc& next) {
    assert(next.cloths.size() == scene_.cloths.size() && next.colliders.size() == scene_.colliders.size());
    (void)world_->save();
    Checkpoint renamed = checkpoint();
    for (std::size_t i = 0; i < next.cloths.size(); ++i) {
        if (next.cloths[i].name == scene_.cloths[i].name) continue;
        auto model = std::make_shared<ClothModel>(*renamed.moment.models[i]);
        model->name = next.cloths[i].name;
        renamed.moment.models[i] = std::move(model);
    }
    for (std::size_t i = 0; i < next.colliders.size(); ++i) renamed.moment.colliders[i].name = next.colliders[i].name;
    renamed.scene = std::make_shared<const SceneDesc>(next);
    SceneDesc before = std::exchange(scene_, next);  // stitches name cloths
    auto gone = go_to(renamed);
    if (!gone) scene_ = std::move(before);
    return gone;
}

std::size_t size_of(const Checkpoint& checkpoint) {
    return size_of(checkpoint.moment) + checkpoint.sources.size() * sizeof(ClothSource);
}

}  // namespace weft
