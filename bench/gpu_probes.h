// Costs of the smallest operations of a device, as a reference for everything built from them.
#pragma once

#include "gpu/device.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace weft::bench {

inline double median(std::vector<double> values) {
    if (values.empty()) return 0;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::ranges::nth_element(values, middle);
    return *middle;
}

struct Probes {
    double dispatch_us = 0;          ///< an empty dispatch of one workgroup and the barrier after it
    double unordered_us = 0;         ///< without the barrier
    std::uint32_t invocations = 0;   ///< of the workgroup that runs the barriers
    double barrier_us = 0;           ///< a barrier(), with a number written to and read from shared memory
    std::uint64_t copied_bytes = 0;  ///< bytes copied from one buffer to another
    double copy_rate = 0;            ///< bytes per second, reads plus writes, by a copy command
    double stream_rate = 0;          ///< the same by a shader

    double best_rate() const { return std::max(copy_rate, stream_rate); }
};

/// Medians of several runs on the device's clock, after some warmup. `quick`: few and small runs, for software drivers.
/// Fails if the device has no clock.
Result<Probes> probe(gpu::Device& device, bool quick);

}  // namespace weft::bench
