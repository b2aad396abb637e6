// The part of World that concerns rigid bodies.
#include "collide/body_mass.h"
#include "solver/state/body_kernels.h"
#include "solver/world/world.h"

#include <algorithm>
#include <cassert>

namespace weft {

// One more body, or as many as before.
Result<void> World::can_move(std::size_t bodies) const {
    const std::uint32_t most = backend_->most_bodies();
    if (bodies <= most) return {};
    return Error{"motion/dynamic", "would be body number " + std::to_string(bodies) + ", but the " +
                                       std::string(backend_->name()) + " backend moves at most " +
                                       std::to_string(most) + " (--backend cpu moves any number)"};
}

std::size_t World::body_count() const {
    return static_cast<std::size_t>(
        std::ranges::count_if(colliders_, [](const Collider& collider) { return !!collider.body; }));
}

Result<void> World::set_body(ColliderId id, std::optional<Body> body, BodyFeatures features) {
    assert(contains(id) && !(body && surface_of(id)));
    Collider& collider = colliders_[colliders_.find(id)];
    if (body && !collider.body)
        if (auto able = can_move(body_count() + 1); !able) return able;
    complete_and_resolve();
    collider.motion.clear();
    collider.next_pose.reset();
    collider.body = std::move(body);
    collider.features = std::move(features);
    if (collider.body) start_body(collider);
    places_->reset();
    replan();
    return {};
}

void World::place_body(ColliderId id, const Pose& pose, Vec3 velocity, Vec3 rate) {
    assert(contains(id));
    complete_and_resolve();
    Collider& collider = colliders_[colliders_.find(id)];
    assert(collider.body);
    collider.body->state = body_state_at(pose, collider.body->mass, velocity, rate);
    collider.pose = pose_of(collider.body->state, collider.body->mass);
}

void World::push_body(ColliderId id, Vec3 impulse, Vec3 point) {
    assert(contains(id));
    complete_and_resolve();
    Body& body = *colliders_[colliders_.find(id)].body;
    scalar::BodyMotion motion = scalar::motion_of(body.state);
    const Vec3 lever = point - body.state.place.xyz();
    scalar::hit_body(motion, 1 / body.mass.mass,
                     {scalar::vector_of(impulse), scalar::vector_of(cross(lever, impulse))});
    body.state = scalar::state_of(motion);
}

const Body& World::body(ColliderId id) const {
    complete();
    const Collider& of = collider(id);
    assert(of.body);
    return *of.body;
}

PlannedCloth World::planned(std::size_t place) const {
    const Cloth& cloth = cloths_[place];
    return {.model = cloth.model.get(),
            .kinematic = !cloth.targets.particles.empty(),
            .grabbed = is_grabbed(cloths_.id_of(place)),
            .attached = is_attached(cloth.targets)};
}

bool World::is_attached(const KinematicTargets& targets) const {
    return std::ranges::any_of(targets.motions, [&](const TargetMotion& motion) {
        const std::size_t place = colliders_.find(motion.collider);
        return place < colliders_.size() && colliders_[place].body;
    });
}

// Rigidly pinned particles move with the body, so it has their mass. Those on springs have anchors, which have none.
BodyMass World::mass_with_cloth(ColliderId id) const {
    const Body& body = *colliders_[colliders_.find(id)].body;
    if (!body.desc.reaction) return body.own;
    std::vector<PointMass> points;
    for (const Cloth& cloth : cloths_) {
        const auto& motions = cloth.targets.motions;
        if (std::ranges::find(motions, id, &TargetMotion::collider) == motions.end()) continue;
        for (const KinematicTarget& target : cloth.targets.particles)
            if (cloth.targets.motions[target.motion].collider == id && target.particle < cloth.model->mass.size())
                points.push_back({target.local, cloth.model->mass[target.particle]});
    }
    return with_points(body.own, points);
}

// Lists the bodies for the next frame, with what is attached to them. Their poses and the velocities of their own
// material stay if that has changed.
void World::begin_bodies() {
    bodies_.clear();
    for (Cloth& cloth : cloths_) cloth.motion_bodies.clear();
    for (std::size_t i = 0; i < colliders_.size(); ++i) {
        if (!colliders_[i].body) continue;
        BodyStep step{.collider = static_cast<std::uint32_t>(i), .state = &colliders_[i].body->state};
        const ColliderId id = colliders_.id_of(i);
        for (Cloth& cloth : cloths_) {
            const auto& motions = cloth.targets.motions;
            for (std::uint32_t m = 0; m < motions.size(); ++m) {
                if (motions[m].collider != id) continue;
                cloth.motion_bodies.resize(motions.size(), none);
                cloth.motion_bodies[m] = static_cast<std::uint32_t>(bodies_.size());
                step.attached += static_cast<std::uint32_t>(
                    std::ranges::count(cloth.targets.particles, m, &KinematicTarget::motion));
            }
        }
        Body& body = *colliders_[i].body;
        if (const BodyMass mass = mass_with_cloth(id); mass != body.mass) {
            const Pose pose = pose_of(body.state, body.mass);
            const Vec3 rate = rate_of(body.state, body.mass);
            const Vec3 lever = pose.rotation * (mass.center - body.mass.center);
            body.state = body_state_at(pose, mass, body.state.velocity.xyz() + cross(rate, lever), rate);
            body.mass = mass;
        }
        bodies_.push_back(step);
    }
}

void World::end_bodies() const {
    for (const BodyStep& step : bodies_) {
        Collider& collider = colliders_[step.collider];
        collider.pose = pose_of(collider.body->state, collider.body->mass);
    }
}

void World::hash_bodies(StateHash& hash) const {
    for (const Collider& collider : colliders_) {
        if (!collider.body) continue;
        const BodyState& state = collider.body->state;
        for (const Vec4& v : {state.place, state.turn, state.velocity, state.spin, state.v_dropped, state.x_dropped})
            hash.add(v.x), hash.add(v.y), hash.add(v.z), hash.add(v.w);
    }
}

std::vector<SavedBody> World::save_bodies() const {
    std::vector<SavedBody> saved;
    for (std::size_t i = 0; i < colliders_.size(); ++i)
        if (colliders_[i].body) saved.push_back({static_cast<std::uint32_t>(i), colliders_[i].body->state});
    return saved;
}

Result<void> World::check_bodies(const Snapshot& snapshot) const {
    const std::size_t bodies = body_count();
    if (snapshot.bodies.size() != bodies)
        return Error{"state", "has " + std::to_string(snapshot.bodies.size()) + " bodies, here there are " +
                                  std::to_string(bodies)};
    std::uint32_t next = 0;
    for (const SavedBody& saved : snapshot.bodies) {
        if (saved.collider < next || saved.collider >= colliders_.size() || !colliders_[saved.collider].body)
            return Error{"state", "has a body in collider " + std::to_string(saved.collider) + ", which is none"};
        next = saved.collider + 1;
    }
    return {};
}

void World::restore_bodies(const std::vector<SavedBody>& saved) {
    for (const SavedBody& one : saved) {
        Body& body = *colliders_[one.collider].body;
        body.mass = mass_with_cloth(colliders_.id_of(one.collider));
        body.state = one.state;
    }
}

}  // namespace weft
