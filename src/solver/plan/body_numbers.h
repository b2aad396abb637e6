// Numbers of bodies that all backends share.
#pragma once

#include "solver/plan/world_plan.h"
#include "solver/state/body_kernels.h"
#include "solver/world/collider.h"

#include <weft/bounds.h>
#include <weft/vector.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace weft {

/// Sweeps over the contacts of bodies with one another and with colliders: after each sweep of particles over the
/// bodies, after each sweep of faces, of which there are more, and for velocities.
inline constexpr std::uint32_t sweeps_after_particles = 3, sweeps_after_faces = 1, sweeps_of_velocities = 4;
/// So many times as many in the first substep of a frame, in which no contact goes on from a substep before.
inline constexpr std::uint32_t more_sweeps_at_first = 4;

constexpr std::uint32_t sweeps_in(std::uint32_t substep, std::uint32_t sweeps) {
    return substep == 0 ? more_sweeps_at_first * sweeps : sweeps;
}

/// Sweeps over the contacts of bodies in PassKind::move_bodies. After pulls, contact of particles follows.
constexpr std::uint32_t sweeps_of_move(std::uint32_t batch, std::uint32_t substep) {
    if (batch == move_after_pulls || batch == move_in_rounds) return 0;
    return sweeps_in(substep, batch == move_after_particles ? sweeps_after_particles : sweeps_after_faces);
}

/// WEFT_FEATURES_… of the collider. A mesh has the features of its hull.
inline int kind_of_features(const Collider& collider) {
    const BodyFeatures& of = collider.features;
    if (collider.shape == ShapeKind::mesh) return WEFT_FEATURES_SOME;
    return of.points.size() == 1 && of.edges.empty() ? WEFT_FEATURES_BALL : WEFT_FEATURES_ALL;
}

/// m: of a ball around the center of mass that holds the box.
inline float radius_about(Vec3 center, const Bounds& box) {
    const auto far = [](float low, float high, float at) { return std::max(std::abs(high - at), std::abs(at - low)); };
    return length({far(box.min.x, box.max.x, center.x), far(box.min.y, box.max.y, center.y),
                   far(box.min.z, box.max.z, center.z)});
}

}  // namespace weft
