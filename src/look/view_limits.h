// What the image of a camera shows: which way is up, and what is too near or too far to be drawn. The renderer and
// everything that works in pixels of its image use the same rules.
#pragma once

#include "look/camera.h"

#include <cmath>

namespace weft {

// In units of the distance from the eye to the target.
inline constexpr float near_plane = 0.005f, far_plane = 60;
inline constexpr float ground_begins_to_fade = 1.5f, ground_ends = 6;
/// m: the least distance to the target that these are multiplied by.
inline constexpr float least_target_distance = 1e-4f;

/// A direction that points up in the image: +y. A camera that looks straight down has -z, one that looks straight up
/// +z, so that both continue the view of a camera that looks along -z and tilts.
inline Vec3 image_up(const Camera& camera) {
    // Below 0.06° from the vertical, rounding of the target's distance would turn the image. User input tilts a camera
    // to 0.1° from the vertical at most (render/orbit.h).
    constexpr float vertical = 1e-3f;
    const Vec3 ahead = normalized(camera.target - camera.position);
    if (std::hypot(ahead.x, ahead.z) > vertical) return {0, 1, 0};
    return {0, 0, ahead.y < 0 ? -1.0f : 1.0f};
}

}  // namespace weft
