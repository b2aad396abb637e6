// The ball that holds a collider in a substep.
#pragma once

#include "cpu/passes.h"

namespace weft::cpu {

/// m, around the origin of the collider's frame; infinite if the kernel of the shape can give less than the distance to
/// such a ball.
float ball_radius(const Collider& collider);

/// `widest`: ContactView::widest.
MovingBall moving_ball(const Collider& collider, float radius, const Pose& before, const Pose& now, float widest);

}  // namespace weft::cpu
