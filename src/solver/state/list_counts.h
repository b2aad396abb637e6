// Sizes of dynamic lists: constraints that are found in every frame.
#pragma once

#include <algorithm>
#include <cstdint>

namespace weft {

/// Internal report of a backend: a list was full, and the frame must run again. Finished frames never have this bit.
inline constexpr std::uint32_t report_list_full = 1u << 31;

/// Counts over all dynamic lists of a frame.
struct ListCounts {
    std::uint64_t rows = 0;      ///< constraints found
    std::uint64_t capacity = 0;  ///< constraints that the lists have room for
    std::uint64_t repeats = 0;   ///< how often cloths ran the frame again: a list was full, or they came near others
    friend bool operator==(const ListCounts&, const ListCounts&) = default;
};

inline constexpr std::uint32_t most_list_rows = 1u << 30;

/// Capacity of a new list, in constraints. If it is too small, a frame runs twice. Results do not depend on it.
constexpr std::uint32_t first_list_capacity(std::uint32_t wanted) {
    return std::clamp(wanted, 16u, most_list_rows);
}
inline constexpr std::uint32_t default_list_capacity = 1024;

/// Capacity after a frame that needed `wanted` constraints: 1.5 times as many, so that a slowly growing list does not
/// make every frame run twice.
constexpr std::uint32_t grown_list_capacity(std::uint64_t wanted) {
    return static_cast<std::uint32_t>(std::min<std::uint64_t>(wanted + wanted / 2, most_list_rows));
}

}  // namespace weft
