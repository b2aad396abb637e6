// The part of World that concerns surfaces of colliders. A surface is a cloth for the backend alone: its particles have
// no weight, and targets move them with the collider.
#include "solver/world/world.h"

#include <algorithm>
#include <cmath>

namespace weft {

/// Without a model if the collider has no surface.
Result<World::Surface> World::make_surface(const Collider& collider) {
    Surface surface;
    if (!collider.surface) return surface;
    surface.model = collider.surface;
    surface.base = space_.take(surface.model->capacity());
    const auto handle = backend_->add_cloth(surface.model, surface.base);
    if (!handle) {
        space_.give_back(surface.base, surface.model->capacity());
        return handle.errors();
    }
    surface.handle = *handle;
    std::vector<Vec3> places;
    for (std::uint32_t p = 0; p < surface.model->particle_count; ++p)
        places.push_back(to_world(collider.pose, surface.model->rest_position(p)));
    if (auto placed = backend_->place_points(surface.handle, 0, places); !placed) {
        backend_->remove_cloth(surface.handle);
        space_.give_back(surface.base, surface.model->capacity());
        return placed.errors();
    }
    surface.moves = !collider.motion.empty();
    for (std::uint32_t p = 0; p < surface.model->particle_count; ++p)
        surface.bounds.include(surface.model->rest_position(p));
    return surface;
}

void World::remove_surface(ColliderId id) {
    const auto surface = std::ranges::find(surfaces_, id, &Surface::collider);
    if (surface == surfaces_.end()) return;
    backend_->remove_cloth(surface->handle);
    space_.give_back(surface->base, surface->model->capacity());
    surfaces_.erase(surface);
}

World::Surface* World::surface_of(ColliderId id) {
    const auto surface = std::ranges::find(surfaces_, id, &Surface::collider);
    return surface == surfaces_.end() ? nullptr : &*surface;
}

std::vector<Vec3> World::places_of(const Surface& surface) const {
    const Pose& pose = collider(surface.collider).pose;
    std::vector<Vec3> places;
    for (std::uint32_t p = 0; p < surface.model->particle_count; ++p)
        places.push_back(to_world(pose, surface.model->rest_position(p)));
    return places;
}

/// Puts all surfaces where their colliders are, at rest.
void World::put_surfaces() {
    for (const Surface& surface : surfaces_) (void)backend_->place_points(surface.handle, 0, places_of(surface));
}

/// Surfaces that begin to move get targets for all of their particles.
void World::begin_surfaces() {
    bool begins = false;
    for (Surface& surface : surfaces_) {
        const bool moves = surface.moves || collider(surface.collider).next_pose;
        begins = begins || moves != surface.moves;
        surface.moves = moves;
        if (!moves || !surface.targets.empty()) continue;
        for (std::uint32_t p = 0; p < surface.model->particle_count; ++p)
            surface.targets.push_back({.particle = p, .motion = 0, .local = surface.model->rest_position(p)});
    }
    if (begins) replan();
}

/// After ColliderPlaces::begin_frame().
void World::place_surfaces() {
    for (Surface& surface : surfaces_) {
        if (!surface.moves) continue;
        const std::size_t place = colliders_.find(surface.collider);
        for (std::uint32_t substep = 0; substep <= settings_.solver.substeps; ++substep)
            surface.poses[substep] = places_->pose(place, substep);
    }
}

/// The most that a point of a surface moves in a substep of the frame, m. A point of a box never moves farther than the
/// farthest of its corners, because two poses of it differ by an affine map.
float World::surface_motion() const {
    float most = 0;
    for (const Surface& surface : surfaces_) {
        if (!surface.moves) continue;
        const Vec3 low = surface.bounds.min, high = surface.bounds.max;
        for (std::size_t substep = 1; substep < surface.poses.size(); ++substep) {
            const Pose &before = surface.poses[substep - 1], &after = surface.poses[substep];
            for (int k = 0; k < 8; ++k) {
                const Vec3 corner{(k & 1) != 0 ? high.x : low.x, (k & 2) != 0 ? high.y : low.y,
                                  (k & 4) != 0 ? high.z : low.z};
                most = std::max(most, length(to_world(after, corner) - to_world(before, corner)));
            }
        }
    }
    return std::isfinite(most) ? most : 0;
}

ClothStep World::step_of(Surface& surface) const {
    static constexpr PlainStiffness no_stiffness{};
    ClothStep step{.cloth = surface.handle, .stiffness = &no_stiffness, .frame = &surface.frame};
    if (!surface.moves) return step;
    step.targets = surface.targets;
    step.motion_poses = surface.poses;
    step.motions = 1;
    return step;
}

}  // namespace weft
