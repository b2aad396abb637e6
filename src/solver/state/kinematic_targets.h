// Kinematic targets: particles whose positions are given, by keys or by a collider.
#pragma once

#include "mesh/triangle_mesh.h"
#include "scene/scene_desc.h"

#include <weft/ids.h>

#include <cstdint>
#include <vector>

namespace weft {

/// A motion of targets: by a collider or by keys.
struct TargetMotion {
    ColliderId collider = {};             ///< null: the targets move by `offsets`
    std::vector<OffsetKey> offsets = {};  ///< by ascending time
};

struct KinematicTarget {
    std::uint32_t particle = 0;  ///< or an anchor; anchors are numbered after the particles
    std::uint32_t motion = 0;    ///< index in `motions`
    Vec3 local = {};             ///< m: in the collider's frame, or without offset
};

/// Targets of one cloth. Their particles have inverse mass 0. Other pinned particles do not move.
struct KinematicTargets {
    std::vector<TargetMotion> motions;
    std::vector<KinematicTarget> particles;  ///< by ascending particle, each at most once
};

}  // namespace weft
