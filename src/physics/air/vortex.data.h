// A Lamb-Oseen vortex. Scene keys; the math is in vortex.kernel.h.
#pragma once

#include "physics/air/wind.h"

namespace weft {

inline constexpr std::string_view vortex_what = "air that turns around the source's local y axis";

inline constexpr Parameter vortex_parameters[] = {
    {.key = "swirl", .offset = offsetof(VortexDesc, swirl), .min = -1e4, .max = 1e4, .unit = "m/s",
     .what = "largest speed around the axis, right-handed; with kind `vortex`"},
    {.key = "inflow", .offset = offsetof(VortexDesc, inflow), .min = -1e4, .max = 1e4, .unit = "m/s",
     .what = "largest speed toward the axis; negative: away from it; with kind `vortex`"},
    {.key = "radius", .offset = offsetof(VortexDesc, radius), .min = 1e-6, .max = far_away, .unit = "m",
     .what = "distance from the axis at which both are largest; with kind `vortex`"},
};

inline WindValues wind_values(const VortexDesc& vortex, Vec3 velocity) {
    // (1 − exp(−s))/s · r with s = α r²/radius² is largest at s = α, the solution of exp(α) = 1 + 2 α. There it is
    // radius/(α + ½).
    constexpr double alpha = 1.2564312086261697;
    const double radius = vortex.radius, per_second = (alpha + 0.5) / radius;
    return {.vectors = {velocity, Vec3{0, 1, 0}},
            .numbers = {static_cast<float>(alpha / (radius * radius)), static_cast<float>(vortex.swirl * per_second),
                        static_cast<float>(vortex.inflow * per_second)}};
}

inline float fastest_wind(const VortexDesc& vortex, Vec3 velocity) {
    return length(velocity) + std::hypot(vortex.swirl, vortex.inflow);
}

}  // namespace weft
