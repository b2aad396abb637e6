// Vectors of doubles for geometry in pixels: positions are floats, but a small error in meters can be many pixels.
#pragma once

#include <weft/vector.h>

#include <cmath>

namespace weft::editor {

struct Double2 {
    double x = 0, y = 0;
};

struct Double3 {
    double x = 0, y = 0, z = 0;
};

constexpr Double2 exact(Vec2 v) {
    return {static_cast<double>(v.x), static_cast<double>(v.y)};
}
constexpr Vec2 rounded(Double2 v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y)};
}
constexpr Double2 operator+(Double2 a, Double2 b) {
    return {a.x + b.x, a.y + b.y};
}
constexpr Double2 operator-(Double2 a, Double2 b) {
    return {a.x - b.x, a.y - b.y};
}
constexpr Double2 operator*(Double2 a, double s) {
    return {a.x * s, a.y * s};
}
constexpr double dot(Double2 a, Double2 b) {
    return a.x * b.x + a.y * b.y;
}
inline double length(Double2 a) {
    return std::hypot(a.x, a.y);
}
inline bool finite(Vec2 a) {
    return std::isfinite(a.x) && std::isfinite(a.y);
}

constexpr Double3 exact(Vec3 v) {
    return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}
constexpr Vec3 rounded(Double3 v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}
constexpr Double3 operator+(Double3 a, Double3 b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
constexpr Double3 operator-(Double3 a, Double3 b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
constexpr Double3 operator*(Double3 a, double s) {
    return {a.x * s, a.y * s, a.z * s};
}
constexpr double dot(Double3 a, Double3 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
constexpr Double3 cross(Double3 a, Double3 b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(Double3 a) {
    return std::sqrt(dot(a, a));
}
/// The unit vector along `a`, or zero where `a` is zero.
inline Double3 normalized(Double3 a) {
    const double l = length(a);
    return l > 0 ? a * (1 / l) : Double3{};
}

}  // namespace weft::editor
