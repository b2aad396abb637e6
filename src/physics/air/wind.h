// Common declarations for the *.data.h files of the winds.
#pragma once

#include "base/parameter.h"

#include <weft/scene.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <string_view>

namespace weft {

/// What the kernel of a wind reads besides the point, named as in wind.kernel.h. Vectors are in the source's local
/// frame; they are rotated to world space before a kernel gets them.
struct WindValues {
    std::array<Vec3, 3> vectors{};
    std::array<float, 3> numbers{};
};

/// A direction and two more that are perpendicular to it and to each other. They depend on the direction alone and are
/// the same on every machine.
struct AcrossWind {
    Vec3 along, first, second;
};
inline AcrossWind across_wind(Vec3 velocity) {
    const Vec3 along = normalized(velocity);
    const Vec3 axis = std::abs(along.y) < 0.7f ? Vec3{0, 1, 0} : Vec3{1, 0, 0};
    const Vec3 across = normalized(cross(along, axis));
    return {along, across, cross(across, along)};
}

}  // namespace weft
