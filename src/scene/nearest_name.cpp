#include "scene/nearest_name.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace weft {
namespace {

// Distance of Damerau and Levenshtein in its restricted form: no letter takes part in two swaps.
std::size_t typing_errors(std::string_view a, std::string_view b) {
    std::vector<std::size_t> before_last(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::swap(before_last, last);
        std::swap(last, row);
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t changed = a[i - 1] != b[j - 1];
            row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + changed});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                row[j] = std::min(row[j], before_last[j - 2] + 1);
        }
    }
    return row[b.size()];
}

std::string listed(std::span<const std::string_view> names, std::string_view last_joint) {
    std::string text;
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (i > 0) text += i + 1 == names.size() ? last_joint : ", ";
        ((text += '"') += names[i]) += '"';
    }
    return text;
}

}  // namespace

std::string_view nearest_name(std::string_view word, std::span<const std::string_view> known) {
    std::string_view nearest;
    std::size_t fewest = std::string_view::npos;
    for (const std::string_view name : known) {
        const std::size_t longer = std::max(word.size(), name.size());
        const std::size_t shorter = std::min(word.size(), name.size());
        const std::size_t allowed = std::max<std::size_t>(longer / 3, 1);
        const bool begins = shorter >= 3 && (name.starts_with(word) || word.starts_with(name));
        if (!begins && longer - shorter > allowed) continue;  // also spares the work for a word of a megabyte
        const std::size_t errors = begins ? 1 : typing_errors(word, name);
        if ((begins || errors <= allowed) && errors < fewest) {
            fewest = errors;
            nearest = name;
        }
    }
    return nearest;
}

std::string alternatives(std::span<const std::string_view> names) {
    return listed(names, " or ");
}

std::string suggestion(std::string_view word, std::span<const std::string_view> known) {
    if (const std::string_view name = nearest_name(word, known); !name.empty())
        return "; did you mean \"" + std::string(name) + "\"?";
    return known.empty() ? "" : "; known are " + listed(known, " and ");
}

}  // namespace weft
