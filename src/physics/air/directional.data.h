// The same wind everywhere. Scene keys; the math is in directional.kernel.h.
#pragma once

#include "physics/air/wind.h"

#include <span>

namespace weft {

inline constexpr std::string_view directional_what = "the same everywhere";

inline constexpr std::span<const Parameter> directional_parameters = {};

inline WindValues wind_values(const DirectionalDesc&, Vec3 velocity) {
    const AcrossWind across = across_wind(velocity);
    return {.vectors = {velocity, across.first, across.second}};
}

/// m/s: upper bound for the velocity, without gusts.
inline float fastest_wind(const DirectionalDesc&, Vec3 velocity) {
    return length(velocity);
}

}  // namespace weft
