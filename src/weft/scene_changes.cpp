// The part of SceneWorld that changes its document into another one.
#include "scene/check.h"
#include "weft/scene_parts.h"
#include "weft/scene_world.h"

#include <algorithm>
#include <utility>

namespace weft {
namespace {

/// Whether the first can be changed to the second while it moves.
bool same_particles(const SceneCloth& a, const SceneCloth& b) {
    return a.mesh == b.mesh && a.render_mesh == b.render_mesh && a.transform == b.transform &&
           a.velocity == b.velocity && a.cuts == b.cuts && a.seams == b.seams;
}
bool same_tearing(const SceneCloth& a, const SceneCloth& b) {
    return a.tearing == b.tearing && a.tear_room == b.tear_room;
}
bool collides_alike(const SceneCloth& a, const SceneCloth& b) {
    return a.self_collision == b.self_collision && a.collision_group == b.collision_group &&
           a.collision_mask == b.collision_mask && a.layer == b.layer;
}
bool differs_in_pins_alone(const SceneCloth& a, const SceneCloth& b) {
    SceneCloth same = without_meshes(a);
    same.pins = b.pins;
    return same == without_meshes(b);
}
bool can_become(const ColliderDesc& a, const ColliderDesc& b) {
    return a.shape == b.shape && a.body == b.body &&
           (b.motion.empty() || (a.motion == b.motion && a.transform == b.transform));
}

}  // namespace

Result<void> SceneWorld::change_to(SceneDesc next) {
    name_unnamed(next);
    Problems problems;
    check_parts(next, problems);
    if (!problems.none()) return std::move(problems).take();
    const Checkpoint before = checkpoint();
    auto done = change_all(next);
    if (!done) {
        (void)go_to(before);  // fitted before
        return done;
    }
    take_order_of(next);
    return {};
}

Result<void> SceneWorld::change_all(const SceneDesc& next) {
    remove_what_is_not_in(next);
    if (auto changed = change_colliders(next); !changed) return changed;
    scene_.gravity = next.gravity;
    set_air(next.air);
    if (next.solver != scene_.solver) {
        if (auto set = set_solver(next.solver); !set) return set;
    }
    if (auto changed = change_cloths(next); !changed) return changed;
    if (auto changed = change_stitches(next); !changed) return changed;
    scene_.name = next.name;
    scene_.frame_rate = next.frame_rate;
    scene_.camera = next.camera;
    scene_.light = next.light;
    return {};
}

// The document has the objects of `next`; puts them, and those of the world, in its order.
void SceneWorld::take_order_of(const SceneDesc& next) {
    std::vector<ClothId> cloths;
    std::vector<ClothSource> sources;
    for (const SceneCloth& cloth : next.cloths) {
        const auto place = static_cast<std::size_t>(find_named(scene_.cloths, cloth.name) - scene_.cloths.data());
        cloths.push_back(world_->cloth_id(place));
        sources.push_back(std::move(sources_[place]));
    }
    std::vector<ColliderId> colliders;
    std::vector<std::uint64_t> serials;
    for (const SceneCollider& collider : next.colliders) {
        const auto place =
            static_cast<std::size_t>(find_named(scene_.colliders, collider.name) - scene_.colliders.data());
        colliders.push_back(world_->collider_id(place));
        serials.push_back(collider_serials_[place]);
    }
    const bool ordered = collider_serials_ == serials &&
                         std::ranges::equal(scene_.cloths, next.cloths, {}, &SceneCloth::name, &SceneCloth::name);
    sources_ = std::move(sources);
    collider_serials_ = std::move(serials);
    scene_.cloths = next.cloths;
    scene_.colliders = next.colliders;
    if (!ordered) world_->reorder(cloths, colliders);
}

// Before the first frame nothing moves yet: whatever differs is made again, so that the world is the one that the
// changed document describes.
void SceneWorld::remove_what_is_not_in(const SceneDesc& next) {
    const bool at_start = world_->index() == 0;
    const bool other_layout = at_start && WorldSettings{.solver = next.solver}.layout() != world_->settings().layout();
    const auto stays = [&](const auto& now, const auto* there, bool can_change) {
        if (!there || !can_change) return false;
        if (!at_start) return true;
        auto same = *there;
        same.material = now.material;
        if constexpr (requires { same.groups; }) same.groups = now.groups;
        return same == now;
    };
    for (std::size_t i = scene_.colliders.size(); i-- > 0;) {
        const SceneCollider* there = find_named(next.colliders, scene_.colliders[i].name);
        if (!stays(scene_.colliders[i], there, there && can_become(scene_.colliders[i], *there)))
            remove(world_->collider_id(i));
    }
    for (std::size_t i = scene_.cloths.size(); i-- > 0;) {
        const SceneCloth* there = find_named(next.cloths, scene_.cloths[i].name);
        const bool can_stay = there && same_particles(scene_.cloths[i], *there) &&
                              (same_tearing(scene_.cloths[i], *there) || can_change_tearing(i, *there));
        if (other_layout || !stays(scene_.cloths[i], there, can_stay)) remove(world_->cloth_id(i));
    }
}

Result<void> SceneWorld::change_stitches(const SceneDesc& next) {
    for (std::size_t i = scene_.stitches.size(); i-- > 0;)
        if (std::ranges::find(next.stitches, scene_.stitches[i]) == next.stitches.end()) remove(stitch_ids_[i]);
    for (std::size_t i = 0; i < next.stitches.size(); ++i) {
        if (std::ranges::find(scene_.stitches, next.stitches[i]) != scene_.stitches.end()) continue;
        if (auto added = add(next.stitches[i], "/stitches/" + std::to_string(i)); !added) return added.errors();
    }
    return {};
}

Result<void> SceneWorld::change_colliders(const SceneDesc& next) {
    for (std::size_t i = 0; i < next.colliders.size(); ++i) {
        const SceneCollider& wanted = next.colliders[i];
        const SceneCollider* there = find_named(scene_.colliders, wanted.name);
        if (!there) {
            if (auto added = add(wanted, "/colliders/" + std::to_string(i)); !added) return added.errors();
            continue;
        }
        const auto place = static_cast<std::size_t>(there - scene_.colliders.data());
        const ColliderId id = world_->collider_id(place);
        scene_.colliders[place].material = wanted.material;
        if (there->friction != wanted.friction) set_friction(id, wanted.friction);
        if (there->transform != wanted.transform || there->motion != wanted.motion)
            move(id, wanted.transform.position, wanted.transform.rotation_degrees);
    }
    return {};
}

Result<void> SceneWorld::change_cloths(const SceneDesc& next) {
    for (std::size_t i = 0; i < next.cloths.size(); ++i) {
        const SceneCloth& wanted = next.cloths[i];
        const SceneCloth* there = find_named(scene_.cloths, wanted.name);
        if (!there) {
            if (auto added = add(wanted, "/cloths/" + std::to_string(i)); !added) return added.errors();
            continue;
        }
        const auto place = static_cast<std::size_t>(there - scene_.cloths.data());
        scene_.cloths[place].material = wanted.material;
        scene_.cloths[place].groups = wanted.groups;
        if (!same_tearing(*there, wanted)) {
            if (auto set = change_tearing(place, wanted); !set) return placed_at(at("/cloths", i), set.errors());
        }
        if (there->resistance != wanted.resistance) {
            if (auto set = change_resistance(place, wanted, at("/cloths", i)); !set) return set;
        }
        if (*there == wanted) continue;
        const ClothId id = world_->cloth_id(place);
        if (there->pins != wanted.pins && differs_in_pins_alone(*there, wanted)) {
            if (auto set = set_pins(id, wanted.pins); !set) return placed_at(at("/cloths", i), set.errors());
            continue;
        }
        Pinned pinned{sources_[place].pins, world_->kinematic_targets(id)};
        std::vector<std::uint32_t> particles = world_->pinned(id);
        if (there->pins == wanted.pins) {
            if (collides_alike(*there, wanted) && there->weights == wanted.weights) {
                auto changed = change_material(place, wanted);
                if (!changed) return changed.errors();
                if (*changed) continue;
            }
        } else {
            auto selected = select_pins_now(*world_, id, sources_[place], wanted.pins);
            if (!selected) return selected.errors();
            pinned = std::move(*selected);
            particles = pinned.pins.particles;
        }
        auto changed = change_cloth(id, without_meshes(wanted), std::move(pinned.pins), std::move(pinned.targets),
                                    std::move(particles));
        if (!changed) return placed_at("/cloths/" + std::to_string(i), changed.errors());
    }
    return {};
}

}  // namespace weft
