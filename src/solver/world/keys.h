// Values that a scene gives at single times, interpolated linearly between these keys and constant before the first and
// after the last one. Keys stand by ascending time.
#pragma once

#include <weft/scene.h>

#include <span>

namespace weft {

/// Position and angles of a collider. There must be a key.
PoseKey key_at(std::span<const PoseKey> keys, double time);
/// Place, direction and strength of a wind. There must be a key.
WindKey key_at(std::span<const WindKey> keys, double time);
/// Offset of a pin in m; 0 without keys.
Vec3 offset_at(std::span<const OffsetKey> keys, double time);

}  // namespace weft
