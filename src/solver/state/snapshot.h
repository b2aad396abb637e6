// Saved state: everything that moves. Restoring it gives the same bits.
#pragma once

#include "base/transform.h"
#include "solver/model/cloth_edit.h"
#include "solver/state/body_state.h"
#include "solver/state/grab.h"
#include "solver/state/kinematic_targets.h"

#include <weft/result.h>
#include <weft/vector.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace weft {

/// Like TargetMotion, with the collider's index; `none` if there is no collider.
struct SavedMotion {
    std::uint32_t collider = none;
    std::vector<OffsetKey> offsets;
};

struct SavedTargets {
    std::vector<SavedMotion> motions;
    std::vector<KinematicTarget> particles;
};

/// position.w is the inverse mass in 1/kg. The w of start, velocity and compensation are the x, y and z of the
/// velocity's compensation (compensated summation), as in a step.
struct ClothSnapshot {
    std::vector<Vec4> position, start, velocity, compensation;  ///< per particle and anchor
    std::vector<float> kept;                                    ///< ClothModel::kept_floats()
    double substep_seconds = 0;                                 ///< s, of the last frame
    std::vector<ClothEdit> edits = {};                          ///< since the cloth was built
    SavedTargets targets = {};                                  ///< of pinned particles and anchors
};

/// A grab, with the index of its cloth.
struct SavedGrab {
    std::uint32_t id = 0;  ///< its index
    std::uint32_t cloth = 0;
    GrabStep step = {};
};

/// A body, with the index of its collider.
struct SavedBody {
    std::uint32_t collider = 0;
    BodyState state = {};
};

struct Snapshot {
    std::uint64_t frame = 0;
    double time = 0;
    std::vector<ClothSnapshot> cloths;
    std::vector<Pose> colliders;
    std::vector<SavedGrab> grabs = {};
    std::vector<SavedBody> bodies = {};
};

std::vector<std::byte> to_bytes(const Snapshot& snapshot);

/// Fails on data that to_bytes() did not write, and on changed or truncated data.
Result<Snapshot> snapshot_from_bytes(std::span<const std::byte> bytes);

/// Fails on values that no world can have. A checksum detects damage, but not data written by other programs.
Result<void> check_numbers(const Snapshot& snapshot);

}  // namespace weft
