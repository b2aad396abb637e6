// Tension and strength of a fabric (law: tear.md).
#pragma once

#include "base/parameter.h"

#include <cstddef>

namespace weft {

/// The default is that of the preset `cotton`. A strength of 0, an energy of 0 and a ratio of 0 set no limit.
struct TearMaterial {
    float strength[2] = {320, 320};  ///< N/m, warp and weft
    float tear_energy = 1.64f;       ///< J/m
    float tear_ratio = 0;            ///< largest length of an edge over that at rest
};

inline constexpr Parameter tear_parameters[] = {
    {.key = "strength", .count = 2, .offset = offsetof(TearMaterial, strength), .min = 0, .max = 1e9, .unit = "N/m",
     .what = "tension along warp and weft that whole cloth carries; 0: no limit"},
    {.key = "tear_energy", .offset = offsetof(TearMaterial, tear_energy), .min = 0, .max = 1e9, .unit = "J/m",
     .what = "energy per length of a rip; sets the limit of tension at the end of a cut; 0: `strength` holds there too"},
    {.key = "tear_ratio", .offset = offsetof(TearMaterial, tear_ratio), .min = 1, .max = 1e3, .zero_too = true,
     .what = "limit of an edge's length over that at rest, the only limit of `inextensible` cloth; 0: none"},
};

}  // namespace weft
