// Suggestions for misspelled names.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace weft {

/// The known name with the fewest typing errors (a letter missing, added, changed, or two swapped), if they are few for
/// its length, or a known name that begins with `word` or that `word` begins with; otherwise empty. Names of up to five
/// letters must also begin like `word`.
std::string_view nearest_name(std::string_view word, std::span<const std::string_view> known);

/// `"a", "b" or "c"`
std::string alternatives(std::span<const std::string_view> names);

/// The end of an error message about a name that has changed: `; this is called "render_mesh" now`. Empty if `word` is
/// not a former name of one of `known`.
std::string former_name(std::string_view word, std::span<const std::string_view> known);

/// The end of an error message about an unknown name: its present name; `; did you mean "density"?` for a similar name
/// or for another word for the same thing, such as `mass`; otherwise `; known are "a", "b" and "c"`.
std::string suggestion(std::string_view word, std::span<const std::string_view> known);

}  // namespace weft
