#include "editor/tools/euler.h"

#include "editor/tools/double3.h"

#include <cmath>
#include <numbers>

namespace weft::editor {
namespace {

constexpr double radian = 180 / std::numbers::pi;  // in degrees

// Columns.
struct Matrix {
    Double3 x, y, z;
};

Double3 operator*(const Matrix& m, Double3 v) {
    return m.x * v.x + m.y * v.y + m.z * v.z;
}
Matrix operator*(const Matrix& a, const Matrix& b) {
    return {a * b.x, a * b.y, a * b.z};
}

// Rodrigues.
Matrix about(Double3 axis, double degrees) {
    const double angle = std::remainder(degrees, 360.0) / radian;
    const double s = std::sin(angle), c = std::cos(angle);
    const auto turned = [&](Double3 v) { return v * c + cross(axis, v) * s + axis * (dot(axis, v) * (1 - c)); };
    return {turned({1, 0, 0}), turned({0, 1, 0}), turned({0, 0, 1})};
}

Matrix matrix_from(Double3 degrees) {
    return about({0, 0, 1}, degrees.z) * (about({0, 1, 0}, degrees.y) * about({1, 0, 0}, degrees.x));
}

// The angle nearest to `near` that is a whole number of turns away.
double nearest_turn(double degrees, double near) {
    return near + std::remainder(degrees - near, 360.0);
}

Double3 nearest_turns(Double3 degrees, Double3 near) {
    return {nearest_turn(degrees.x, near.x), nearest_turn(degrees.y, near.y), nearest_turn(degrees.z, near.z)};
}

Double3 angles_of(const Matrix& m, Double3 near) {
    constexpr double locked = 1e-6;  // below it, rounding hides x and z
    const double cos_y = std::hypot(m.x.x, m.x.y);
    if (cos_y < locked) {
        const bool up = m.x.z < 0;  // y = 90°: x - z is known; y = -90°: x + z
        const double known = (up ? std::atan2(m.y.x, m.z.x) : std::atan2(-m.y.x, -m.z.x)) * radian;
        const double off = std::remainder(known - (up ? near.x - near.z : near.x + near.z), 360.0) / 2;
        return {near.x + off, nearest_turn(up ? 90 : -90, near.y), up ? near.z - off : near.z + off};
    }
    const Double3 first{std::atan2(m.y.z, m.z.z) * radian, std::atan2(-m.x.z, cos_y) * radian,
                        std::atan2(m.x.y, m.x.x) * radian};
    const Double3 a = nearest_turns(first, near);
    const Double3 b = nearest_turns({first.x + 180, 180 - first.y, first.z + 180}, near);
    return dot(b - near, b - near) < dot(a - near, a - near) ? b : a;
}

}  // namespace

Vec3 angles_near(const Mat3& rotation, Vec3 near) {
    return rounded(angles_of({exact(rotation.x), exact(rotation.y), exact(rotation.z)}, exact(near)));
}

Vec3 turned_angles(Vec3 start, Vec3 axis, double degrees) {
    const Double3 around = normalized(exact(axis));
    if (!finite(start) || !(length(around) > 0) || !std::isfinite(degrees) || degrees == 0) return start;
    constexpr double step = 1, most_turns = 100;
    // Whole turns beyond what anybody drags are left out, so that the work is limited.
    if (std::abs(degrees) > most_turns * 360) degrees = std::remainder(degrees, 360.0);
    const Matrix first = matrix_from(exact(start));
    // About these two axes one angle alone changes. They come from matrices of floats.
    constexpr double parallel = 1e-6;
    if (std::hypot(around.x, around.y) < parallel)
        return rounded(exact(start) + Double3{0, 0, std::copysign(degrees, around.z * degrees)});
    if (length(cross(around, first.x)) < parallel)
        return rounded(exact(start) + Double3{std::copysign(degrees, dot(around, first.x) * degrees), 0, 0});
    Double3 angles = exact(start);
    const double direction = degrees < 0 ? -1 : 1;
    for (double turned = step; turned < std::abs(degrees); turned += step)  // always the same steps on the way
        angles = angles_of(about(around, direction * turned) * first, angles);
    return rounded(angles_of(about(around, degrees) * first, angles));
}

}  // namespace weft::editor
