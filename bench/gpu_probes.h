// What a device needs for the smallest of things: the measure for all that is made of them.
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
    double dispatch_us = 0;          ///< a dispatch of one workgroup that does nothing, and the barrier after it
    double unordered_us = 0;         ///< without the barrier
    std::uint32_t invocations = 0;   ///< of the workgroup that meets at
    double barrier_us = 0;           ///< a barrier(), with a number to and from shared memory
    std::uint64_t copied_bytes = 0;  ///< so many from one buffer to another
    double copy_rate = 0;            ///< bytes a second, read and written ones together: by a copy command
    double stream_rate = 0;          ///< by a shader

    double best_rate() const { return std::max(copy_rate, stream_rate); }
};

/// Medians of several runs, by the device's clock, after some to get warm. `quick`: few and small, for a device that is
/// played by a CPU. Fails without a clock.
Result<Probes> probe(gpu::Device& device, bool quick);

}  // namespace weft::bench
