// Finds which elements of two lists belong together.
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <vector>

namespace weft {

/// An element that was kept, perhaps with another value; without `to` it was removed, without `from` it is new.
struct JsonMatch {
    std::optional<std::size_t> from, to;
};

/// Both lists in order, with as many equal elements as possible, then objects of one name, then objects that share
/// members.
std::vector<JsonMatch> match_lists(const nlohmann::json& from, const nlohmann::json& to);

}  // namespace weft
