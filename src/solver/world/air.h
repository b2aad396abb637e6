// Winds, evaluated for one frame.
#pragma once

#include "base/transform.h"
#include "scene/scene_desc.h"

#include <array>
#include <cstdint>
#include <vector>

namespace weft {

enum class WindKind : std::uint32_t {
#define WEFT_WIND(name, Name) name,
#include "physics/air/winds.def"
#undef WEFT_WIND
};

#define WEFT_WIND(name, Name) +1
inline constexpr std::uint32_t wind_kind_count = 0
#include "physics/air/winds.def"
    ;
#undef WEFT_WIND

/// Parameters of a wind at one time, in world space, named as in wind.kernel.h. Plain numbers for all backends.
struct WindNow {
    WindKind kind{};
    std::array<Vec3, 3> vectors{};   ///< defined in the kind's kernel file
    std::array<float, 3> numbers{};  ///< likewise
    Vec3 position;
    Mat3 axes;
    Vec3 edge;
    float per_border = 1, strength = 1;
    float shelter = 0;  ///< m; 0: colliders do not stop the wind
    float gust = 0, gust_turns = 0, gust_per_meter = 0;
    bool scattered = false;
    float turbulence = 0, noise_per_meter = 0, noise_time = 0;
    Vec3 noise_offset;
};

/// `time`: s.
WindNow wind_at(const WindDesc& wind, double time);

/// m/s: upper bound for the speed of a wind at any place and time, with its gusts.
double top_speed(const WindDesc& wind);

/// Sum of all winds in m/s at a point, for triangle `number`. Same values as the `wind` pass, but
/// without shelter; for single evaluations.
Vec3 wind_velocity(const std::vector<WindNow>& winds, Vec3 position, std::uint32_t number);

}  // namespace weft
