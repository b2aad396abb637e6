// One line about each value of choices that no table of parameters lists.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace weft::editor {

/// A line per way in which a collider can move: `static`, `keys` and `dynamic`.
std::vector<std::string_view> motion_words();

/// A line per preset of a fabric, such as `350 g/m²`, or of a material. Empty for other keys.
std::vector<std::string> preset_words(const std::string& place, const std::vector<std::string>& names);

}  // namespace weft::editor
