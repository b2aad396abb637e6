#include "base/transform.h"

#include <cmath>
#include <numbers>

namespace weft {
namespace {

struct SinCos {
    float sin, cos;
};

// Quarter turns come from a table: cos(90°) computed from π in floating point is not zero, and a flat sheet turned by
// 90° must stay exactly flat.
SinCos sin_cos_degrees(float degrees) {
    const double turns = std::remainder(static_cast<double>(degrees), 360.0);
    if (turns == 0) return {0, 1};
    if (turns == 90) return {1, 0};
    if (turns == -90) return {-1, 0};
    if (turns == 180 || turns == -180) return {0, -1};
    const double radians = turns * std::numbers::pi / 180;
    return {static_cast<float>(std::sin(radians)), static_cast<float>(std::cos(radians))};
}

struct Quaternion {
    float x, y, z, w;
};

float dot(const Quaternion& a, const Quaternion& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w;
}

Quaternion normalized(const Quaternion& q) {
    const float inverse = 1 / std::sqrt(dot(q, q));
    return {q.x * inverse, q.y * inverse, q.z * inverse, q.w * inverse};
}

// Computes the largest component first, which avoids division by a small one.
Quaternion quaternion_of(const Mat3& m) {
    const float xx = m.x.x, yy = m.y.y, zz = m.z.z;
    Quaternion q{};
    if (xx + yy + zz > 0) {
        q = {m.y.z - m.z.y, m.z.x - m.x.z, m.x.y - m.y.x, 1 + xx + yy + zz};
    } else if (xx > yy && xx > zz) {
        q = {1 + xx - yy - zz, m.y.x + m.x.y, m.z.x + m.x.z, m.y.z - m.z.y};
    } else if (yy > zz) {
        q = {m.y.x + m.x.y, 1 + yy - zz - xx, m.z.y + m.y.z, m.z.x - m.x.z};
    } else {
        q = {m.z.x + m.x.z, m.z.y + m.y.z, 1 + zz - xx - yy, m.x.y - m.y.x};
    }
    return normalized(q);
}

Mat3 matrix_of(const Quaternion& q) {
    return {{1 - 2 * (q.y * q.y + q.z * q.z), 2 * (q.x * q.y + q.w * q.z), 2 * (q.x * q.z - q.w * q.y)},
            {2 * (q.x * q.y - q.w * q.z), 1 - 2 * (q.x * q.x + q.z * q.z), 2 * (q.y * q.z + q.w * q.x)},
            {2 * (q.x * q.z + q.w * q.y), 2 * (q.y * q.z - q.w * q.x), 1 - 2 * (q.x * q.x + q.y * q.y)}};
}

}  // namespace

Vec4 quaternion_from(const Mat3& rotation) {
    const Quaternion q = quaternion_of(rotation);
    return {q.x, q.y, q.z, q.w};
}

Bounds to_world(const Pose& pose, const Bounds& local) {
    if (local.empty()) return {};
    const Vec3 center = to_world(pose, local.center()), half = local.size() * 0.5f;
    const auto reach = [&](float x, float y, float z) {
        return std::abs(x) * half.x + std::abs(y) * half.y + std::abs(z) * half.z;
    };
    const Mat3& r = pose.rotation;
    const Vec3 by{reach(r.x.x, r.y.x, r.z.x), reach(r.x.y, r.y.y, r.z.y), reach(r.x.z, r.y.z, r.z.z)};
    return {center - by, center + by};
}

Pose between(const Pose& from, const Pose& to, float fraction) {
    if (fraction <= 0 || from == to) return from;
    if (fraction >= 1) return to;
    const Vec3 position = from.position + (to.position - from.position) * fraction;
    if (from.rotation == to.rotation) return {from.rotation, position};
    const Quaternion a = quaternion_of(from.rotation), b = quaternion_of(to.rotation);
    const float s = 1 - fraction, t = dot(a, b) < 0 ? -fraction : fraction;
    const Quaternion q{s * a.x + t * b.x, s * a.y + t * b.y, s * a.z + t * b.z, s * a.w + t * b.w};
    return {matrix_of(normalized(q)), position};
}

Mat3 rotation_from_degrees(Vec3 degrees) {
    const auto [sx, cx] = sin_cos_degrees(degrees.x);
    const auto [sy, cy] = sin_cos_degrees(degrees.y);
    const auto [sz, cz] = sin_cos_degrees(degrees.z);
    const Mat3 rx{{1, 0, 0}, {0, cx, sx}, {0, -sx, cx}};
    const Mat3 ry{{cy, 0, -sy}, {0, 1, 0}, {sy, 0, cy}};
    const Mat3 rz{{cz, sz, 0}, {-sz, cz, 0}, {0, 0, 1}};
    return rz * (ry * rx);
}

}  // namespace weft
