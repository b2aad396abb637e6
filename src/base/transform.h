// Placement of meshes and colliders: rotation and position, angles in degrees.
#pragma once

#include <weft/bounds.h>
#include <weft/vector.h>

namespace weft {

/// Column vectors of a rotation.
struct Mat3 {
    Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
    friend constexpr bool operator==(const Mat3&, const Mat3&) = default;
};

constexpr Vec3 operator*(const Mat3& m, Vec3 v) {
    return m.x * v.x + m.y * v.y + m.z * v.z;
}
constexpr Mat3 operator*(const Mat3& a, const Mat3& b) {
    return {a * b.x, a * b.y, a * b.z};
}
constexpr Mat3 transposed(const Mat3& m) {
    return {{m.x.x, m.y.x, m.z.x}, {m.x.y, m.y.y, m.z.y}, {m.x.z, m.y.z, m.z.z}};
}

inline constexpr float radians_per_degree = 0.017453292519943295f;

/// R = Rz·Ry·Rx, angles in degrees about the fixed axes. Multiples of 90° are exact.
Mat3 rotation_from_degrees(Vec3 degrees);

/// The unit quaternion x, y, z, w of a rotation.
Vec4 quaternion_from(const Mat3& rotation);

/// world = rotation · local + position
struct Pose {
    Mat3 rotation;
    Vec3 position;
    friend constexpr bool operator==(const Pose&, const Pose&) = default;
};

constexpr Vec3 to_world(const Pose& pose, Vec3 local) {
    return pose.rotation * local + pose.position;
}
/// The box around a box that has been placed; empty if that is empty.
Bounds to_world(const Pose& pose, const Bounds& local);
constexpr Vec3 to_local(const Pose& pose, Vec3 world) {
    return transposed(pose.rotation) * (world - pose.position);
}

/// Interpolates by the shortest rotation and along a straight line; `fraction` is 0…1, exact at both ends. It
/// interpolates normalized quaternions linearly, so the angular speed is not constant: for a quarter turn it deviates
/// by 3 %, for small turns the error is invisible.
Pose between(const Pose& from, const Pose& to, float fraction);

}  // namespace weft
