#include "io/scenes/json_match.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace weft {
namespace {

using nlohmann::json;

constexpr std::size_t max_compared_pairs = std::size_t{1} << 20;

double likeness(const json& a, const json& b) {
    if (a == b) return 4;
    if (a.is_structured() != b.is_structured()) return 0.1;
    if (!a.is_object() || !b.is_object()) return 0.5;
    std::size_t same = 0;
    for (const auto& [key, value] : a.items())
        if (const auto other = b.find(key); other != b.end() && *other == value) ++same;
    const double share = static_cast<double>(same) / static_cast<double>(std::max(a.size(), b.size()));
    const auto name_a = a.find("name"), name_b = b.find("name");
    if (name_a == a.end() || name_b == b.end()) return 1 + share;
    return *name_a == *name_b ? 2.5 + share : 0.3 + share;
}

// The alignment with the greatest sum of likenesses.
void match_parts(const json& from, const json& to, std::size_t begin, std::size_t from_end, std::size_t to_end,
                 std::vector<JsonMatch>& matches) {
    const std::size_t rows = from_end - begin, columns = to_end - begin;
    std::vector<double> best((rows + 1) * (columns + 1)), pair(rows * columns);
    const auto at = [&](std::size_t i, std::size_t j) -> double& { return best[i * (columns + 1) + j]; };
    for (std::size_t i = rows; i-- > 0;) {
        for (std::size_t j = columns; j-- > 0;) {
            pair[i * columns + j] = likeness(from[begin + i], to[begin + j]);
            at(i, j) = std::max({at(i + 1, j), at(i, j + 1), at(i + 1, j + 1) + pair[i * columns + j]});
        }
    }
    std::size_t i = 0, j = 0;
    while (i < rows || j < columns) {
        if (i < rows && j < columns && at(i, j) == at(i + 1, j + 1) + pair[i * columns + j]) {
            matches.push_back({begin + i++, begin + j++});
        } else if (i < rows && (j == columns || at(i, j) == at(i + 1, j))) {
            matches.push_back({begin + i++, {}});
        } else {
            matches.push_back({{}, begin + j++});
        }
    }
}

}  // namespace

std::vector<JsonMatch> match_lists(const json& from, const json& to) {
    std::vector<JsonMatch> matches;
    const std::size_t shorter = std::min(from.size(), to.size());
    std::size_t begin = 0, same_at_end = 0;
    while (begin < shorter && from[begin] == to[begin]) ++begin;
    while (begin + same_at_end < shorter && from[from.size() - 1 - same_at_end] == to[to.size() - 1 - same_at_end])
        ++same_at_end;
    for (std::size_t i = 0; i < begin; ++i) matches.push_back({i, i});
    const std::size_t from_end = from.size() - same_at_end, to_end = to.size() - same_at_end;
    if ((from_end - begin) * (to_end - begin) <= max_compared_pairs) {
        match_parts(from, to, begin, from_end, to_end, matches);
    } else {
        for (std::size_t i = begin; i < std::max(from_end, to_end); ++i)
            matches.push_back(
                {i < from_end ? std::optional(i) : std::nullopt, i < to_end ? std::optional(i) : std::nullopt});
    }
    for (std::size_t i = 0; i < same_at_end; ++i) matches.push_back({from_end + i, to_end + i});
    return matches;
}

}  // namespace weft
