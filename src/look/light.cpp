#include "look/light.h"

#include <cmath>
#include <numbers>

namespace weft {

Vec3 direction_of(const Sun& sun) {
    constexpr float degree = std::numbers::pi_v<float> / 180;
    const float azimuth = sun.azimuth * degree, elevation = sun.elevation * degree;
    return {std::sin(azimuth) * std::cos(elevation), std::sin(elevation), std::cos(azimuth) * std::cos(elevation)};
}

}  // namespace weft
