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

/// Scratch memory of a sort, in bytes; for record_sort(), its addresses.
struct SortScratch {
    std::uint64_t places = 0, sums = 0;
};
SortScratch sort_scratch(std::uint32_t count);

/// Number of bits that numbers below `end` need.
std::uint32_t bits_below(std::uint32_t end);

/// Sorts ascending by high, then low; equal keys keep their order. Only the low `bits` bits of each word may be set:
/// fewer bits need fewer passes. Writes to both sets of arrays and returns the one that holds the result.
KeyArrays record_sort(Recorder& recorder, KeyArrays keys, KeyArrays spare, std::uint32_t count, std::uint32_t bits,
                      SortScratch addresses);

struct KeyedValue {
    std::uint32_t high = 0, low = 0, value = 0;
    friend constexpr bool operator==(const KeyedValue&, const KeyedValue&) = default;
};

/// Uploads the keys, sorts them and downloads the result.
Result<std::vector<KeyedValue>> sort_keys(gpu::Device& device, Programs& programs, std::span<const KeyedValue> keys,
                                          std::uint32_t bits = 32);

}  // namespace weft::vulkan
