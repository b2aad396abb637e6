// A reference that needs no other program: how many bytes a frame has to move, pass by pass, and how long that takes at
// the rate at which this machine copies.
#pragma once

#include "solver/world/world.h"

#include <array>
#include <cstddef>

namespace weft::cli {

/// What a frame reads and writes if every pass of the plan streams each thing it touches once. Counted from the plan,
/// the constraints' arities and fields, and which particles their batches touch: a new constraint is counted as it is.
struct FrameTraffic {
    std::array<double, stage_count> bytes{};  ///< a frame, all cloths, by stage
    double working_set = 0;                   ///< bytes that a substep goes over; of the largest cloth

    double all() const;
};
FrameTraffic frame_traffic(const World& world);

/// Bytes a second, read ones and written ones together, of `threads` threads copying within so many bytes; the best of
/// some milliseconds, so that what else runs on the machine counts little.
double copy_bandwidth(unsigned threads, std::size_t bytes);

/// So many bytes that copying them is the memory's work, not the caches': twice the last cache, within 64 to 256 MiB,
/// since more takes longer to get hold of than all else here.
std::size_t beyond_caches();

}  // namespace weft::cli
