// Numbers of bodies that all backends share.
#pragma once

#include <weft/bounds.h>
#include <weft/vector.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace weft {

/// Sweeps over the contacts of bodies with one another and with colliders: after each sweep of particles over the
/// bodies, after each sweep of faces, of which there are more, and for velocities.
inline constexpr std::uint32_t sweeps_after_particles = 3, sweeps_after_faces = 1, sweeps_of_velocities = 4;

/// m: of a ball around the center of mass that holds the box.
inline float radius_about(Vec3 center, const Bounds& box) {
    const auto far = [](float low, float high, float at) { return std::max(std::abs(high - at), std::abs(at - low)); };
    return length({far(box.min.x, box.max.x, center.x), far(box.min.y, box.max.y, center.y),
                   far(box.min.z, box.max.z, center.z)});
}

}  // namespace weft
