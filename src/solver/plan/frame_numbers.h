// What a frame's settings come to for one cloth, the same for every backend.
#pragma once

#include "solver/plan/world_plan.h"
#include "solver/world/collider.h"

namespace weft {

/// m/s at which cloth that starts a substep inside a collider leaves it: quick for the eye, too slow to fling the
/// cloth.
inline constexpr float depenetration_speed = 1.0f;

struct FrameNumbers {
    float h;               ///< s: length of the substep
    float max_speed;       ///< m/s
    float viscous;         ///< s²: retardation time times the frame that damping acts for
    float half_thickness;  ///< m
    float depenetration;   ///< m, of a substep
};

FrameNumbers frame_numbers(const ClothModel& model, const WorldPlan& plan, double dt);

/// Static and kinetic friction of a cloth and a collider.
std::array<float, 2> friction_between(const ClothModel& model, const Collider& collider);

/// s: a substep, as the lambda of stretch that it leaves is to be read; 0 for plain constraints, which have no
/// compliance: what they leave is C itself.
double lambda_seconds(const WorldPlan& plan, double dt);

/// What makes the cloth stretch in this frame, beyond what its limits have room for: the tension that the last frame
/// left in it, and pins that are held too far apart.
struct FrameLimits {
    float tension = 0;  ///< N/m
    float allowed = 1;
};

/// `lambda` is that of stretch, `substep_seconds` the last frame's lambda_seconds.
FrameLimits frame_limits(const ClothModel& model, std::span<const float> lambda, double substep_seconds,
                         std::span<const Vec4> positions);

/// Whether anything asks for them.
bool has_limits(const ClothModel& model, const WorldPlan& plan);

}  // namespace weft
