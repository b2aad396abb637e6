// Changes the text of a scene file and leaves everything else in it as it is.
#pragma once

#include <weft/result.h>

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace weft {

/// The text with as few changes as possible so that it reads as `wanted`. Comments, order of keys, line breaks,
/// spelling of numbers and indentation of all that has not changed stay to the byte.
///
/// * A value is replaced in its place. Objects and lists are changed member by member.
/// * New keys follow the last member of their object, with the indentation of the other members. An object on one line
///   stays there if it fits into 120 columns.
/// * A removed member takes its line with it, and the comments on that line and directly above. A comment above several
///   members stays.
///
/// Fails if the text is not JSON, and if the changed text does not read as `wanted`.
Result<std::string> edit_scene_text(std::string_view text, const nlohmann::json& wanted);

}  // namespace weft
