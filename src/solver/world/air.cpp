#include "solver/world/air.h"

#include "physics/scalar.h"

#include <cmath>

namespace weft {
namespace {

std::array<Vec3, 3> numbers_of(const WindDesc& wind) {
    // Two arbitrary directions perpendicular to the wind, the same on every machine.
    const Vec3 along = normalized(wind.velocity);
    const Vec3 axis = std::abs(along.y) < 0.7f ? Vec3{0, 1, 0} : Vec3{1, 0, 0};
    const Vec3 across = normalized(cross(along, axis));
    return {wind.velocity, across, cross(across, along)};
}

// Integers in 0 … 288 (the noise has period 289), different for each seed below 289³.
Vec3 offset_of(std::uint32_t seed) {
    return {static_cast<float>(seed % 289), static_cast<float>(seed / 289 % 289),
            static_cast<float>(seed / 289 / 289 % 289)};
}

scalar::vec3 spread(Vec3 v) {
    return {v.x, v.y, v.z};
}

}  // namespace

WindNow wind_at(const WindDesc& wind, double time) {
    return {.kind = wind.kind,
            .numbers = numbers_of(wind),
            .gust = wind.gust.amplitude,
            // Reduced by the periods that the kernels use: 16 turns of a gust here, 289 of the noise below.
            .gust_turns = static_cast<float>(std::fmod(wind.gust.frequency * time, 16.0)),
            .gust_per_meter = 1 / wind.gust.scale,
            .scattered = wind.gust.phase == GustPhase::scattered,
            .turbulence = wind.turbulence.strength,
            .noise_per_meter = 1 / wind.turbulence.scale,
            .noise_time = wind.turbulence.period > 0
                              ? static_cast<float>(std::fmod(time / wind.turbulence.period + 0.5, 289.0))
                              : 0.5f,
            .noise_offset = offset_of(wind.seed)};
}

Vec3 wind_velocity(const std::vector<WindNow>& winds, Vec3 position, std::uint32_t number) {
    scalar::vec3 sum(0.0f);
    for (const WindNow& wind : winds) {
        const scalar::WindNumbers numbers{spread(wind.numbers[0]), spread(wind.numbers[1]), spread(wind.numbers[2])};
        const scalar::WindLife life{
            wind.gust,       wind.gust_turns,      wind.gust_per_meter, wind.scattered ? 1.0f : 0.0f,
            wind.turbulence, wind.noise_per_meter, wind.noise_time,     spread(wind.noise_offset)};
        scalar::Flow flow{};
        switch (wind.kind) {
#define WEFT_WIND(name, Name)                                  \
    case WindKind::name:                                       \
        flow = scalar::flow_##name(spread(position), numbers); \
        break;
#include "physics/air/winds.def"
#undef WEFT_WIND
        }
        sum = sum + scalar::live_wind(flow, static_cast<float>(number), life);
    }
    return {sum.x, sum.y, sum.z};
}

}  // namespace weft
