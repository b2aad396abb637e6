// Air: the aerodynamic coefficients of a fabric.
#pragma once

#include "base/parameter.h"

namespace weft {

/// `cosine`: lift grows with |v · n|, as for an inclined plate. `sine`: with |v × n|, as in some published programs.
enum class LiftModel { cosine, sine };

struct AirMaterial {
    float drag = 1.28f;  ///< C_D; 1.28 for a flat plate across the flow
    float lift = 0.6f;   ///< C_L
    LiftModel lift_model = LiftModel::cosine;
};

inline constexpr Parameter air_parameters[] = {
    {.key = "drag", .offset = offsetof(AirMaterial, drag), .min = 0, .max = 1e3,
     .what = "drag coefficient; 1.28 for a flat plate across the flow; acts if the scene has air"},
    {.key = "lift", .offset = offsetof(AirMaterial, lift), .min = 0, .max = 1e3,
     .what = "lift coefficient; acts if the scene has air"},
    {.key = "lift_model", .kind = ParameterKind::choice, .offset = offsetof(AirMaterial, lift_model),
     .what = "lift grows with the `cosine` or the `sine` of the angle between flow and normal",
     .choices = "cosine|sine",
     .choice_words = "most lift when the air meets the cloth head-on|most lift when the air passes along the cloth"},
};

}  // namespace weft
