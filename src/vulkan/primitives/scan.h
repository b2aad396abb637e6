// Prefix sums of 32-bit numbers, modulo 2³².
#pragma once

#include "gpu/device.h"
#include "vulkan/primitives/recorder.h"

#include <cstdint>
#include <span>
#include <vector>

namespace weft::vulkan {

/// Bytes of scratch memory for a scan of `count` numbers: the sums of tiles.
std::uint64_t scan_scratch(std::uint32_t count);

/// Takes addresses on the device; `result` may be `source`.
void record_scan(Recorder& recorder, std::uint64_t source, std::uint64_t result, std::uint32_t count,
                 std::uint64_t scratch, bool inclusive = false);

/// Upload the numbers, scan them and download the result. Result i is the sum of numbers 0 … i-1, or of 0 … i.
Result<std::vector<std::uint32_t>> exclusive_scan(gpu::Device& device, Programs& programs,
                                                  std::span<const std::uint32_t> numbers);
Result<std::vector<std::uint32_t>> inclusive_scan(gpu::Device& device, Programs& programs,
                                                  std::span<const std::uint32_t> numbers);

}  // namespace weft::vulkan
