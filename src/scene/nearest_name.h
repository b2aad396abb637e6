// What a misspelled name was probably meant to be.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace weft {

/// The known name that is fewest typing errors away (a letter missing, added, changed, or two swapped) if those are few
/// for its length, or of which `word` is the beginning; otherwise empty.
std::string_view nearest_name(std::string_view word, std::span<const std::string_view> known);

/// `"a", "b" or "c"`
std::string alternatives(std::span<const std::string_view> names);

/// For the end of a message about an unknown name: `; did you mean "density"?`, or where nothing is near,
/// `; known are "a", "b" and "c"`.
std::string suggestion(std::string_view word, std::span<const std::string_view> known);

}  // namespace weft
