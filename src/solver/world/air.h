// The air around the cloths, and the winds that move it.
#pragma once

#include "scene/scene_desc.h"

#include <array>
#include <cstdint>
#include <vector>

namespace weft {

#define WEFT_WIND(name, Name) +1
inline constexpr std::uint32_t wind_kind_count = 0
#include "physics/air/winds.def"
    ;
#undef WEFT_WIND

/// What a wind is at one moment, as wind.kernel.h names it. Plain numbers, ready for any backend.
struct WindNow {
    WindKind kind{};
    std::array<Vec3, 3> numbers{};  ///< as the kind's kernel file states
    float gust = 0, gust_turns = 0, gust_per_meter = 0;
    bool scattered = false;
    float turbulence = 0, noise_per_meter = 0, noise_time = 0;
    Vec3 noise_offset;
};

WindNow wind_at(const WindDesc& wind, double time);

/// m/s: all winds together at a point, for the triangle of that number. What the `wind` pass computes, one evaluation.
Vec3 wind_velocity(const std::vector<WindNow>& winds, Vec3 position, std::uint32_t number);

}  // namespace weft
