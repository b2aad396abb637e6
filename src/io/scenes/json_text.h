// Parses JSON text, with the limits that untrusted files need.
#pragma once

#include "scene/problems.h"

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string_view>

namespace weft {

inline constexpr std::size_t max_json_bytes = std::size_t{64} << 20;
/// Limit for the values in one text. A value takes at least 16 bytes, so this limit bounds the memory.
inline constexpr std::size_t max_json_values = std::size_t{8} << 20;
/// Limit for the nesting of objects and lists. A scene needs eight levels.
inline constexpr std::size_t max_json_depth = 64;

/// Accepts comments and a byte order mark. A syntax error is reported alone, at a place such as `line 3, column 5`; of
/// repeated keys in an object, which are reported, the last is kept. Nothing if no value could be read.
std::optional<nlohmann::json> parse_json(std::string_view text, Problems& problems);

}  // namespace weft
