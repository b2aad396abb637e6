// Sorting of pairs of words, each with a value.
#pragma once

#include "gpu/device.h"
#include "vulkan/primitives/recorder.h"

#include <cstdint>
#include <span>
#include <vector>

namespace weft::vulkan {

/// Arrays on the device, of 32-bit words: a key is (high, low).
struct KeyArrays {
    std::uint64_t high = 0, low = 0, value = 0;
};

/// What a sort of so many needs besides, bytes.
struct SortScratch {
    std::uint64_t places = 0, sums = 0;
};
SortScratch sort_scratch(std::uint32_t count);

/// The bits of numbers below `end`.
std::uint32_t bits_below(std::uint32_t end);

/// Ascending by high, then low; equal keys keep their order. Words have `bits` bits, no others may be set: the fewer,
/// the fewer passes. Writes to both sets of arrays and returns the one that holds the result. `places` and `sums`:
/// addresses of scratch memory.
KeyArrays record_sort(Recorder& recorder, KeyArrays keys, KeyArrays spare, std::uint32_t count, std::uint32_t bits,
                      SortScratch addresses);

struct KeyedValue {
    std::uint32_t high = 0, low = 0, value = 0;
    friend constexpr bool operator==(const KeyedValue&, const KeyedValue&) = default;
};

/// There and back.
Result<std::vector<KeyedValue>> sort_keys(gpu::Device& device, Programs& programs, std::span<const KeyedValue> keys,
                                          std::uint32_t bits = 32);

}  // namespace weft::vulkan
