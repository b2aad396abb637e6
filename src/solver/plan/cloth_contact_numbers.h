// Numbers of contact between cloths, shared by all backends.
#pragma once

#include "collide/uneven_thickness.h"
#include "solver/model/cloth_model.h"

#include <algorithm>
#include <cstdint>

namespace weft {

/// Rounds of constraints, one sweep over contacts and colliders in a substep. More rounds make a pile quieter: the
/// constraints answer what contact has moved.
inline constexpr std::uint32_t contact_rounds = 4;
/// Sweeps that follow the last round where the limit would have to act.
inline constexpr int contact_extra_sweeps = 4;
/// Gap that a pair keeps at least, as a part of its thickness. Without it gaps of micrometers stay closed forever.
inline constexpr float contact_gap_floor = 0.1f;
/// m/s at which an overlap from before the substep is removed at most.
inline constexpr float contact_recovery_speed = 1;
/// Least thickness of a pair, m. With less, rounding would decide about the gap that a pair keeps.
inline constexpr float least_contact_thickness = 1e-4f;
/// Part of the mass splitting that a sweep uses; 1 would be stable for any number of pairs, and slower.
inline constexpr float contact_split = 0.3f;
/// m/s: relative speed of an edge and a triangle that untangling takes apart, and the most that it adds to the speed of
/// a particle.
inline constexpr float untangling_speed = 0.6f;
/// How deep a pair may lose its gap before contact, as a part of contact_cap(). What constraints ask beyond it, contact
/// could not take back; both sides then go only a part of their way.
inline constexpr float contact_brake_depth = 0.5f;
/// How often the limit makes a particle slide along its pairs before it shortens what is left of its motion, and how
/// often it halves that before the particle has to stay.
inline constexpr std::uint32_t limit_slides = 4, limit_halvings = 3;
/// How far sliding may lead from the way on which the particle was, as a part of contact_cap().
inline constexpr float limit_aside = 0.1f;
/// How often it may send a particle back.
inline constexpr std::uint32_t most_retreats = limit_slides + limit_halvings + 1;
/// How much nearer than the largest distance for contact the limit keeps what surfaces carry along, in own caps.
inline constexpr float limit_carry_margin = 0.5f;
/// How often the limit may start again because a particle left its listed trajectory.
inline constexpr int contact_most_attempts = 20;

/// contact_cap() of particles that belong to the surface of a collider, which contact does not move.
inline constexpr float cap_of_surface = 1e9f;

/// How thick a cloth is in its pairs where its factor is this, m: a pair has the mean of both features, each as thick
/// as at its thinnest corner. Surfaces of colliders have no thickness, so cloth keeps half of its own from them, as
/// from any collider.
inline float pair_thickness(const ClothModel& model, float factor) {
    if (model.collision.surface) return 0;
    return std::max(model.fabric.contact.thickness * factor, least_contact_thickness);
}
/// Where the cloth is thickest.
inline float pair_thickness(const ClothModel& model) {
    return pair_thickness(model, model.thickness_range[1]);
}
/// The same at every particle, if they differ.
inline UnevenThickness uneven_pair_thickness(const ClothModel& model) {
    if (model.thickness_factors.empty() || model.collision.surface) return {};
    return {model.thickness_factors.data(), model.fabric.contact.thickness, least_contact_thickness};
}

/// Whether the normals of a cloth's pairs are made perpendicular to its features. The closest points of a pair at the
/// least gap, pair_thickness()/10, are rounded by 6e-8 m near 1 m. Over an edge that tilts the normal by as much as the
/// gap if thickness² is below 100 · 6e-8 m · edge.
inline bool is_thin(const ClothModel& model) {
    const float thickness = pair_thickness(model, model.thickness_range[0]);
    return !model.collision.surface && thickness * thickness < 6e-6f * model.mean_edge;
}

/// How far all rounds together may move a particle from where the first constraints left it, m.
inline float contact_cap(const ClothModel& model) {
    return 0.14f * model.mean_edge;
}
/// The most that the motion of surfaces may add to a cap, in caps: 4 mean edges.
inline constexpr float most_carried = 28;
/// The same in a frame in which surfaces of colliders move by `surface_motion` m in a substep at most: contact has to
/// carry cloth along.
inline float carried_cap(float cap, float surface_motion) {
    return cap + std::min(surface_motion, most_carried * cap);
}

}  // namespace weft
