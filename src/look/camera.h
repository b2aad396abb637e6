// The camera of a scene.
#pragma once

#include "base/parameter.h"

#include <weft/vector.h>

namespace weft {

struct Camera {
    Vec3 position{1.5f, 1.2f, 1.5f};  ///< m
    Vec3 target{0, 0.5f, 0};          ///< m
    float fov = 40;                   ///< degrees, vertical
    friend bool operator==(const Camera&, const Camera&) = default;
};

// One entry per scene key.
// clang-format off
inline constexpr Parameter camera_parameters[] = {
    {.key = "position", .kind = ParameterKind::vector, .count = 3, .offset = offsetof(Camera, position),
     .min = -far_away, .max = far_away, .unit = "m", .what = "position of the camera"},
    {.key = "target", .kind = ParameterKind::vector, .count = 3, .offset = offsetof(Camera, target),
     .min = -far_away, .max = far_away, .unit = "m", .what = "point at the center of the image"},
    {.key = "fov", .offset = offsetof(Camera, fov), .min = 1, .max = 150, .unit = "°",
     .what = "vertical field of view"},
};
// clang-format on

}  // namespace weft
