#include "base/transform.h"

#include <cmath>
#include <numbers>

namespace weft {
namespace {

struct SinCos {
    float sin, cos;
};

// Quarter turns by table: cos(90°) computed from π in floating point is not zero, and a sheet turned by 90° should be
// as flat as it was.
SinCos sin_cos_degrees(float degrees) {
    const double turns = std::remainder(static_cast<double>(degrees), 360.0);
    if (turns == 0) return {0, 1};
    if (turns == 90) return {1, 0};
    if (turns == -90) return {-1, 0};
    if (turns == 180 || turns == -180) return {0, -1};
    const double radians = turns * std::numbers::pi / 180;
    return {static_cast<float>(std::sin(radians)), static_cast<float>(std::cos(radians))};
}

}  // namespace

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
