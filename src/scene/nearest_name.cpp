#include "scene/nearest_name.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace weft {
namespace {

/// A former name of a scene key or value, and a name that is known beside it now.
struct FormerName {
    std::string_view before, now;
    std::string_view hint = {};  ///< end of the message, where `now` is not simply the new name
};

// A former name may have several present ones.
constexpr FormerName former_names[] = {
    {"drawn", "render_mesh"},
    {"look", "material"},
    {"look", "colliders", "; each cloth and each collider has a key \"material\" now"},
    {"hinges", "bend_edges"},
    {"hinges", "dihedral"},
    {"source", "no-diagonals"},
    {"plate", "cosine"},
    {"listing", "sine"},
    {"thread", "thread_spacing"},
    {"relief", "weave_depth"},
    {"map_repeat", "uv_tiling"},
    {"roughness_matte", "diffuse_roughness"},
    {"strength", "intensity"},
    {"size", "angular_diameter"},
    {"occlusion", "ambient_occlusion"},
};

/// A name that weft does not use, and the name of the key that a user most likely means.
struct OtherName {
    std::string_view word, meant;
};

constexpr OtherName other_names[] = {
    {"speed", "velocity"},
    {"mass", "density"},
    {"weight", "density"},
    {"fps", "frame_rate"},
    {"wind", "air"},
    {"objects", "colliders"},
    {"obstacles", "colliders"},
    {"fixed", "pins"},
    {"self_contact", "self_collision"},
    {"translation", "position"},
    {"orientation", "rotation"},
    {"size", "half_extents"},
    {"height", "half_height"},
    {"look_at", "target"},
    {"eye", "position"},
    {"field_of_view", "fov"},
    {"albedo", "color"},
    {"base_color", "color"},
    {"texture", "color_map"},
    {"opacity", "coverage"},
    {"brightness", "intensity"},
    {"steps", "substeps"},
};

char lower(char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

// In a short word one error changes much. The first letter is rarely wrong, except that it is swapped with the second.
bool begin_alike(std::string_view word, std::string_view name) {
    if (word.empty() || name.empty()) return false;
    const bool swapped = word.size() > 1 && name.size() > 1 && word[0] == name[1] && word[1] == name[0];
    return lower(word[0]) == name[0] || swapped;
}

// Restricted Damerau-Levenshtein distance: no letter takes part in two swaps.
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
        if (longer <= 5 && !begin_alike(word, name)) continue;
        const bool begins = shorter >= 3 && (name.starts_with(word) || word.starts_with(name));
        if (!begins && longer - shorter > allowed) continue;  // also keeps the cost low for very long words
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

std::string former_name(std::string_view word, std::span<const std::string_view> known) {
    for (const auto& [before, now, hint] : former_names) {
        if (word != before || std::ranges::find(known, now) == known.end()) continue;
        return hint.empty() ? "; this is called \"" + std::string(now) + "\" now" : std::string(hint);
    }
    return "";
}

std::string suggestion(std::string_view word, std::span<const std::string_view> known) {
    if (std::string now = former_name(word, known); !now.empty()) return now;
    for (const auto& [other, meant] : other_names)
        if (word == other && std::ranges::find(known, meant) != known.end())
            return "; did you mean \"" + std::string(meant) + "\"?";
    if (const std::string_view name = nearest_name(word, known); !name.empty())
        return "; did you mean \"" + std::string(name) + "\"?";
    return known.empty() ? "" : "; known are " + listed(known, " and ");
}

}  // namespace weft
