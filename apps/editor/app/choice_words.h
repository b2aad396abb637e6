// One line about each value that a choice can have.
#pragma once

#include "base/parameter.h"

#include <string>
#include <string_view>
#include <vector>

namespace weft::editor {

/// A line per name of the choice, in the order of choice_names(); empty if the names of this choice need none.
std::vector<std::string_view> choice_words(const Parameter& parameter);

/// The same for ways in which a collider can move: `static`, `keys` and `dynamic`.
std::vector<std::string_view> motion_words();

/// A line per preset of a fabric, such as `350 g/m²`, or of a material. Empty for other keys.
std::vector<std::string> preset_words(const std::string& place, const std::vector<std::string>& names);

}  // namespace weft::editor
