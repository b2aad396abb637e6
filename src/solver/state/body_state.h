// What moves of a rigid body.
#pragma once

#include "base/transform.h"
#include "physics/body/body_mass.h"

#include <cstdint>

namespace weft {

/// In the layout of a device: blocks of four floats. BodyMotion in body.kernel.h says what they mean.
struct BodyState {
    Vec4 place;      ///< m, of the center of mass; w unused
    Vec4 turn;       ///< a unit quaternion: x, y, z, w
    Vec4 velocity;   ///< m/s; w unused
    Vec4 spin;       ///< kg·m²/s, angular momentum; w unused
    Vec4 v_dropped;  ///< compensation; w unused
    Vec4 x_dropped;  ///< compensation; w unused
    friend bool operator==(const BodyState&, const BodyState&) = default;
};

/// A body that is at `pose`, with the velocity of its center of mass in m/s and an angular velocity in rad/s.
BodyState body_state_at(const Pose& pose, const BodyMass& mass, Vec3 velocity = {}, Vec3 rate = {});
/// Where the body's frame is.
Pose pose_of(const BodyState& state, const BodyMass& mass);
/// rad/s
Vec3 rate_of(const BodyState& state, const BodyMass& mass);
/// J: of its motion and of its rotation.
double kinetic_energy(const BodyState& state, const BodyMass& mass);
bool is_finite(const BodyState& state);

}  // namespace weft
