// A round turbulent jet. Scene keys; the math is in jet.kernel.h.
#pragma once

#include "physics/air/wind.h"

namespace weft {

inline constexpr std::string_view jet_what = "a round turbulent jet from a nozzle";

inline constexpr Parameter jet_parameters[] = {
    {.key = "diameter", .offset = offsetof(JetDesc, diameter), .min = 1e-6, .max = far_away, .unit = "m",
     .what = "diameter of the nozzle; with kind `jet`"},
};

inline WindValues wind_values(const JetDesc& jet, Vec3 velocity) {
    const AcrossWind across = across_wind(velocity);
    return {.vectors = {velocity, across.first, across.second}, .numbers = {jet.diameter}};
}

inline float fastest_wind(const JetDesc&, Vec3 velocity) {
    return length(velocity);
}

}  // namespace weft
