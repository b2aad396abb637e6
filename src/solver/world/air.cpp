#include "solver/world/air.h"

#include "physics/air/winds.def"
#include "physics/scalar.h"
#include "solver/world/keys.h"

#include <algorithm>
#include <cmath>

namespace weft {
namespace {

#define WEFT_WIND(name, Name)                       \
    constexpr WindKind kind_of(const Name##Desc&) { \
        return WindKind::name;                      \
    }
#include "physics/air/winds.def"
#undef WEFT_WIND

// Beyond any place, with room for a square in single precision.
constexpr float no_edge = 1e18f;

// Integers in 0 … 288 (the noise has period 289), different for each seed below 289³.
Vec3 offset_of(std::uint32_t seed) {
    return {static_cast<float>(seed % 289), static_cast<float>(seed / 289 % 289),
            static_cast<float>(seed / 289 / 289 % 289)};
}

// Bounded, so that it gives a finite number with any distance.
float per_meter(float scale) {
    return std::min(1 / scale, 1e18f);
}

scalar::vec3 spread(Vec3 v) {
    return {v.x, v.y, v.z};
}

scalar::Flow flow_at(const WindNow& wind, scalar::vec3 from_source) {
    const scalar::WindNumbers numbers{spread(wind.vectors[0]), spread(wind.vectors[1]), spread(wind.vectors[2]),
                                      wind.numbers[0],         wind.numbers[1],         wind.numbers[2]};
    switch (wind.kind) {
#define WEFT_WIND(name, Name) \
    case WindKind::name:      \
        return scalar::flow_##name(from_source, numbers);
#include "physics/air/winds.def"
#undef WEFT_WIND
    }
    return {};
}

}  // namespace

WindNow wind_at(const WindDesc& wind, double time) {
    WindKey key{.position = wind.transform.position, .rotation_degrees = wind.transform.rotation_degrees};
    if (!wind.motion.empty()) key = key_at(wind.motion, time);
    WindNow now{.position = key.position,
                .axes = rotation_from_degrees(key.rotation_degrees),
                .edge = {no_edge, no_edge, no_edge},
                .strength = key.strength,
                .shelter = wind.shelter,
                .gust = wind.gust.amplitude,
                // Reduced by the periods that the kernels use: 16 turns of a gust here, 289 of the noise below.
                .gust_turns = static_cast<float>(std::fmod(wind.gust.frequency * time, 16.0)),
                .gust_per_meter = per_meter(wind.gust.scale),
                .scattered = wind.gust.phase == GustPhase::scattered,
                .turbulence = wind.turbulence.strength,
                .noise_per_meter = per_meter(wind.turbulence.scale),
                .noise_time = wind.turbulence.period > 0
                                  ? static_cast<float>(std::fmod(time / wind.turbulence.period + 0.5, 289.0))
                                  : 0.5f,
                .noise_offset = offset_of(wind.seed)};
    std::visit(
        [&](const auto& kind) {
            const WindValues values = wind_values(kind, wind.velocity);
            now.kind = kind_of(kind);
            std::ranges::transform(values.vectors, now.vectors.begin(), [&](Vec3 v) { return now.axes * v; });
            now.numbers = values.numbers;
        },
        wind.kind);
    if (wind.box) {
        // A border of no width is a step: in single precision no place is within it.
        const float border = std::max(wind.box->border, 1e-12f);
        now.edge = wind.box->half_extents + Vec3{border, border, border};
        now.per_border = 1 / border;
    }
    return now;
}

double top_speed(const WindDesc& wind) {
    const double flow =
        std::visit([&](const auto& kind) { return static_cast<double>(fastest_wind(kind, wind.velocity)); }, wind.kind);
    double strength = wind.motion.empty() ? 1 : 0;
    for (const WindKey& key : wind.motion) strength = std::max(strength, std::abs(static_cast<double>(key.strength)));
    return flow * strength * (1.0 + std::abs(wind.gust.amplitude) + std::abs(wind.turbulence.strength));
}

Vec3 wind_velocity(const std::vector<WindNow>& winds, Vec3 position, std::uint32_t number) {
    scalar::vec3 sum(0.0f);
    for (const WindNow& wind : winds) {
        const scalar::WindLife life{
            wind.gust,       wind.gust_turns,      wind.gust_per_meter, wind.scattered ? 1.0f : 0.0f,
            wind.turbulence, wind.noise_per_meter, wind.noise_time,     spread(wind.noise_offset)};
        const scalar::WindBounds bounds{spread(wind.axes.x), spread(wind.axes.y), spread(wind.axes.z),
                                        spread(wind.edge),   wind.per_border,     wind.strength};
        const scalar::vec3 from_source = spread(position) - spread(wind.position);
        sum = sum + scalar::live_wind(flow_at(wind, from_source), static_cast<float>(number), life) *
                        scalar::wind_share(from_source, bounds);
    }
    return {sum.x, sum.y, sum.z};
}

}  // namespace weft
