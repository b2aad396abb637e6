// JSON text to values, with every limit that a file from anywhere needs.
#pragma once

#include "scene/problems.h"

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string_view>

namespace weft {

inline constexpr std::size_t max_json_bytes = std::size_t{64} << 20;
/// Values in one text. Sixteen bytes or more each: an endless list ends before memory does.
inline constexpr std::size_t max_json_values = std::size_t{8} << 20;
/// Objects and lists inside each other. A scene needs eight.
inline constexpr std::size_t max_json_depth = 64;

/// Comments and a byte order mark are allowed. A syntax error comes back alone, its place `line 3, column 5`; keys that
/// an object holds twice are reported and the last of them kept. Nothing if no value could be read.
std::optional<nlohmann::json> parse_json(std::string_view text, Problems& problems);

}  // namespace weft
