// Angles of rotations, R = Rz·Ry·Rx in degrees as in TransformDesc.
#pragma once

#include "base/transform.h"

namespace weft::editor {

/// Of all angles that describe the rotation, those nearest to `near`. They may exceed ±180°.
Vec3 angles_near(const Mat3& rotation, Vec3 near);

/// The angles of rotation_from_degrees(start) turned by `degrees` about a unit axis in the world. They follow the turn
/// from `start` on continuously: none jumps by 360°, and a turn about an axis of the angles themselves adds up beyond
/// 360°. They depend on the arguments alone. At gimbal lock, where y is an odd multiple of 90°, only the sum or the
/// difference of x and z has a meaning; a turn that starts there may change each of them by up to 90° at once.
Vec3 turned_angles(Vec3 start, Vec3 axis, double degrees);

}  // namespace weft::editor
