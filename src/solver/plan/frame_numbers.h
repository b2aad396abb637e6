// Numbers that follow from a frame's settings for one cloth, shared by all backends.
#pragma once

#include "solver/plan/world_plan.h"
#include "solver/world/collider.h"

namespace weft {

/// Speed in m/s at which cloth that starts a substep inside a collider is pushed out: fast enough to look immediate,
/// too slow to throw the cloth.
inline constexpr float depenetration_speed = 1.0f;

/// A tile whose particles move is expected to stay in a box that is larger by this part of their way.
inline constexpr float tile_slack_per_way = 0.25f;

struct FrameNumbers {
    float h;                                    ///< s: length of a substep
    float max_speed;                            ///< m/s
    float viscous;                              ///< s²: retardation time times length of the frame
    float half_thickness;                       ///< m, of the fabric
    std::array<float, 2> half_thickness_range;  ///< m: where the cloth is thinnest and thickest
    float depenetration;                        ///< m per substep
    float hand_reach;                           ///< m: GrabRow::reach
    float tile_margin;  ///< m: a tile's colliders are searched this far around it, for contact and constraints
};

/// If an edge is longer than widest_face(), the colliders of tiles are searched farther: for edges this many times as
/// long, so that cloth that is being stretched is not searched again in every substep.
inline constexpr float room_to_stretch = 1.5f;

FrameNumbers frame_numbers(const ClothModel& model, const WorldPlan& plan, double dt);

/// Static and kinetic friction between a cloth and a collider.
std::array<float, 2> friction_between(const ClothModel& model, const Collider& collider);

/// The same as in physics/contact/face.kernel.h.
inline float nearest_of_faces(float half_thickness) {
    return 0.5f * half_thickness;
}

/// m: the longest edge that a face is expected to have. Its colliders are looked for that far around each corner, and
/// farther while an edge is longer.
inline float widest_face(const ClothModel& model) {
    return 1.2f * model.longest_edge;
}

/// m: radius of the largest circle around a face.
inline float circle_of_faces(const ClothModel& model) {
    constexpr float circle_per_edge = 0.57735f;  // of an equilateral triangle
    return circle_per_edge * widest_face(model);
}

/// Whether faces of the cloth may touch the collider where their corners do not: it has edges or corners, or is round
/// and small for the cloth's edges.
bool faces_touch(const ClothModel& model, const Collider& collider);

/// Length of the substep in s, for reading the lambda of stretch. 0 for plain position-based dynamics, which has no
/// compliance: its residual is C itself.
double lambda_seconds(const WorldPlan& plan, double dt);

/// Reasons to extend the limits of coarse constraints and tethers in this frame: `tension`, the tension of the last
/// frame in excess of what the limits already allow; `allowed`, a factor on the limits for pins that are too far apart.
struct FrameLimits {
    float tension = 0;  ///< N/m
    float allowed = 1;
};

/// `lambda`: of the stretch constraints. `substep_seconds`: lambda_seconds() of the last frame.
FrameLimits frame_limits(const ClothModel& model, std::span<const float> lambda, double substep_seconds,
                         std::span<const Vec4> positions);

/// Whether the cloth has constraints that use FrameLimits.
bool has_limits(const ClothModel& model, const WorldPlan& plan);

}  // namespace weft
