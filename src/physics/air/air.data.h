// Air: what a fabric does to the air that flows past it.
#pragma once

#include "base/parameter.h"

namespace weft {

/// `plate`: lift as of an inclined plate. `listing`: with |v × n| where the plate has v · n, as some program listings of this model have it.
enum class LiftModel { plate, listing };

struct AirMaterial {
    float drag = 1.28f;  ///< C_D; 1.28 is a flat plate broadside
    float lift = 0.6f;   ///< C_L
    LiftModel lift_model = LiftModel::plate;
};

inline constexpr Parameter air_parameters[] = {
    {.key = "drag", .offset = offsetof(AirMaterial, drag), .min = 0, .max = 1e3,
     .what = "drag coefficient; a flat plate broadside has 1.28; where the scene has air"},
    {.key = "lift", .offset = offsetof(AirMaterial, lift), .min = 0, .max = 1e3,
     .what = "lift coefficient; where the scene has air"},
    {.key = "lift_model", .kind = ParameterKind::choice, .offset = offsetof(AirMaterial, lift_model),
     .what = "`plate`: lift grows with the cosine of the angle between flow and normal; `listing`: with its sine",
     .choices = "plate|listing"},
};

}  // namespace weft
