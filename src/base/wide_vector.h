// A vector of doubles, for geometry that floats are too coarse for.
#pragma once

#include <weft/vector.h>

#include <cmath>

namespace weft {

struct WideVec3 {
    double x = 0, y = 0, z = 0;
};

constexpr WideVec3 operator+(const WideVec3& a, const WideVec3& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
constexpr WideVec3 operator-(const WideVec3& a, const WideVec3& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
constexpr WideVec3 operator*(const WideVec3& a, double s) {
    return {a.x * s, a.y * s, a.z * s};
}
constexpr double dot(const WideVec3& a, const WideVec3& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
constexpr WideVec3 cross(const WideVec3& a, const WideVec3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(const WideVec3& a) {
    return std::sqrt(dot(a, a));
}

constexpr WideVec3 wide(Vec3 v) {
    return {double{v.x}, double{v.y}, double{v.z}};
}
constexpr Vec3 narrow(const WideVec3& v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

}  // namespace weft
