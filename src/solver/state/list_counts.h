// How long lists of constraints are that are found while the world moves.
#pragma once

#include <algorithm>
#include <cstdint>

namespace weft {

/// In a backend's reports, until the frame has been run again: there were more rows than a list has room for. Frames
/// that are done do not have it.
inline constexpr std::uint32_t report_list_full = 1u << 31;

/// Of all dynamic lists of a frame.
struct ListCounts {
    std::uint64_t rows = 0;      ///< found
    std::uint64_t capacity = 0;  ///< rows that there is room for
    std::uint64_t repeats = 0;   ///< times that the frame was run again because a list was full
    friend bool operator==(const ListCounts&, const ListCounts&) = default;
};

inline constexpr std::uint32_t most_list_rows = 1u << 30;

/// Rows that a new list has room for. It depends on nothing but the settings: a list that is too short costs a frame
/// that is run twice, and no bit of a result depends on how long it is.
constexpr std::uint32_t first_list_capacity(std::uint32_t wanted) {
    return std::clamp(wanted, 16u, most_list_rows);
}
inline constexpr std::uint32_t default_list_capacity = 1024;

/// After a frame that wanted so many: half as many again, so that a list that grows slowly does not run every frame
/// twice.
constexpr std::uint32_t grown_list_capacity(std::uint64_t wanted) {
    return static_cast<std::uint32_t>(std::min<std::uint64_t>(wanted + wanted / 2, most_list_rows));
}

}  // namespace weft
