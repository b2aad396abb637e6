// A reference that needs no other program: the bytes that a frame must move, pass by pass, and the time for that at
// this machine's copy bandwidth.
#pragma once

#include "solver/world/world.h"

#include <array>
#include <cstddef>

namespace weft::cli {

/// The bytes that a frame reads and writes if every pass streams each thing it touches once. Computed from the plan,
/// the arities and fields of the constraints, and the particles that their batches touch, so new constraints are
/// included.
struct FrameTraffic {
    std::array<double, stage_count> bytes{};  ///< per frame, all cloths, by stage
    double working_set = 0;                   ///< bytes that a substep uses; of the largest cloth

    double all() const;
};
FrameTraffic frame_traffic(const World& world);

/// Bytes per second, reads plus writes, of `threads` threads that copy within `bytes` bytes. The best of some
/// milliseconds, so that other load on the machine has little influence.
double copy_bandwidth(unsigned threads, std::size_t bytes);

/// A size at which copies are limited by memory, not by caches: twice the last-level cache, within 64 to 256 MiB,
/// because allocating more would take longer than the measurement.
std::size_t beyond_caches();

}  // namespace weft::cli
