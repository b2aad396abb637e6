// Rigid bodies of a scene and of a Simulation.
#include "scene/check.h"
#include "scene/scene_keys.h"
#include "weft/body_building.h"
#include "weft/simulation_impl.h"

#include <algorithm>
#include <utility>
#include <variant>

namespace weft {
namespace {

// Of an id that names no body.
Error no_body(const World& world, ColliderId id) {
    if (!world.contains(id)) return no_such("collider");
    return {"collider", "is no body: only a collider with a \"dynamic\" motion can be pushed and placed"};
}

bool is_body(const World& world, ColliderId id) {
    return world.contains(id) && world.collider(id).body;
}

}  // namespace

Result<void> SceneWorld::set_body(ColliderId id, const std::optional<BodyDesc>& body) {
    SceneCollider& document = scene_.colliders[place_of(id)];
    ColliderDesc desc = document;
    desc.body = body;
    if (body) desc.motion.clear();
    const auto sound = checked([&](Problems& problems) { check_collider(desc, "", problems); });
    if (!sound) return sound;
    Collider made = world_->collider(id);
    if (made.surface && body)
        return Error{"/motion/dynamic",
                     "needs a closed mesh whose contact is \"solid\": cloth meets this one as a surface"};
    made.body.reset();
    if (std::holds_alternative<SolidMeshDesc>(desc.shape)) made.features = {};
    if (auto added = add_body(made, desc, world_->colliders(), "", notes_); !added) return added;
    if (auto set = world_->set_body(id, std::move(made.body), std::move(made.features)); !set) return set;
    document.body = body;
    document.motion.clear();
    return {};
}

Result<void> Simulation::set_body(ColliderId id, const std::optional<BodyDesc>& body) {
    if (!impl_->world().contains(id)) return no_such("collider");
    return impl_->scene.set_body(id, body);
}

Result<void> Simulation::place_body(ColliderId id, Vec3 position, Vec3 rotation_degrees, Vec3 velocity, Vec3 spin) {
    if (!is_body(impl_->world(), id)) return no_body(impl_->world(), id);
    const TransformDesc transform{.position = position, .rotation_degrees = rotation_degrees};
    BodyDesc start;
    start.velocity = velocity, start.spin = spin;
    const auto sound = checked([&](Problems& problems) {
        check_values(pose_keys, &transform, "", problems);
        check_values(rigid_body_parameters, &start, "", problems);
    });
    if (!sound) return sound;
    impl_->world().place_body(id, {rotation_from_degrees(rotation_degrees), position}, velocity,
                              spin * radians_per_degree);
    return {};
}

Result<void> Simulation::push(ColliderId id, Vec3 impulse, Vec3 point) {
    if (!is_body(impl_->world(), id)) return no_body(impl_->world(), id);
    const auto sound = checked([&](Problems& problems) {
        check_values(impulse_keys, &impulse, "", problems);
        check_values(point_keys, &point, "", problems);
    });
    if (!sound) return sound;
    impl_->world().push_body(id, impulse, point);
    return {};
}

std::optional<BodyMotion> Simulation::body(ColliderId id) const {
    if (!is_body(impl_->world(), id)) return std::nullopt;
    const Body& body = impl_->world().body(id);
    const BodyState& state = body.state;
    return BodyMotion{.position = pose_of(state, body.mass).position,
                      .rotation = state.turn,
                      .center = state.place.xyz(),
                      .velocity = state.velocity.xyz(),
                      .spin = rate_of(state, body.mass) * (1 / radians_per_degree),
                      .mass = double{body.mass.mass},
                      .energy = kinetic_energy(state, body.mass)};
}

}  // namespace weft
