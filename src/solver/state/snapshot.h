// Everything that moves, at one moment: what brings a world back to it, to the bit.
#pragma once

#include "base/transform.h"
#include "solver/model/cloth_edit.h"
#include "solver/state/holds.h"

#include <weft/result.h>
#include <weft/vector.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace weft {

/// As Mover, with the collider by its place among all; `none` for none.
struct SavedMover {
    std::uint32_t collider = none;
    std::vector<OffsetKey> offsets;
};

struct SavedHolds {
    std::vector<SavedMover> movers;
    std::vector<HeldParticle> particles;
};

/// The fourth floats of position are inverse masses, 1/kg; those of start, velocity and carry hold what rounding
/// dropped from the velocity, as in a step.
struct ClothSnapshot {
    std::vector<Vec4> position, start, velocity, carry;  ///< per particle and anchor
    std::vector<float> lambda;                           ///< of the rows of stretch, which tell how taut the cloth is
    double substep_seconds = 0;                          ///< of the last frame
    std::vector<ClothEdit> edits = {};                   ///< since the cloth was built
    SavedHolds holds = {};                               ///< what carries pinned particles and anchors along
};

struct Snapshot {
    std::uint64_t frame = 0;
    double time = 0;
    std::vector<ClothSnapshot> cloths;
    std::vector<Pose> colliders;
};

std::vector<std::byte> to_bytes(const Snapshot& snapshot);

/// Fails on what to_bytes did not write, or what was changed or cut off since.
Result<Snapshot> snapshot_from_bytes(std::span<const std::byte> bytes);

/// Fails on numbers that no world has: a checksum says that they are as they were written, not by whom.
Result<Done> check_numbers(const Snapshot& snapshot);

}  // namespace weft
