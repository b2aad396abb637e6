// Where a scene is seen from.
#pragma once

#include "base/parameter.h"

#include <weft/vector.h>

namespace weft {

struct Camera {
    Vec3 position{1.5f, 1.2f, 1.5f};  ///< m
    Vec3 target{0, 0.5f, 0};          ///< m
    float fov = 40;                   ///< degrees, from the bottom of the picture to its top
    friend bool operator==(const Camera&, const Camera&) = default;
};

// One entry is one key.
// clang-format off
inline constexpr Parameter camera_parameters[] = {
    {.key = "position", .kind = ParameterKind::vector, .count = 3, .offset = offsetof(Camera, position),
     .min = -far_away, .max = far_away, .unit = "m", .what = "where the eye is"},
    {.key = "target", .kind = ParameterKind::vector, .count = 3, .offset = offsetof(Camera, target),
     .min = -far_away, .max = far_away, .unit = "m", .what = "what is in the middle of the picture"},
    {.key = "fov", .offset = offsetof(Camera, fov), .min = 1, .max = 150, .unit = "°",
     .what = "angle from the bottom of the picture to its top"},
};
// clang-format on

}  // namespace weft
