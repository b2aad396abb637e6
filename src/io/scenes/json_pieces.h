// Splits the text of a JSON object or list into its members and what stands around them.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace weft {

/// A member of an object or an element of a list. The parts follow one another in the text in this order; a comma is
/// between `before_comma` and `tail` unless the member is the last one.
struct JsonPiece {
    std::string_view lead;   ///< blanks and comments before it
    std::string_view key;    ///< with its quotes; empty in a list
    std::string_view colon;  ///< from the key to the value
    std::string_view value;
    std::string_view before_comma;  ///< blanks and comments
    std::string_view tail;          ///< comments on the rest of its line
};

struct JsonPieces {
    std::string_view open_tail;  ///< comments on the line of the opening bracket
    std::vector<JsonPiece> pieces;
    std::string_view close;  ///< blanks and comments before the closing bracket
};

/// The value of a text, without blanks, comments and byte order mark around it. The text must be JSON that parse_json()
/// accepts, here and below.
std::string_view json_value_in(std::string_view text);
/// `container`: from bracket to bracket.
JsonPieces json_pieces(std::string_view container);

/// The places of line breaks in blanks and comments, except those within a comment. `\r\n` is one break.
std::vector<std::size_t> line_breaks(std::string_view blanks);
/// Whether the text, of blanks and comments, ends in a comment that only a line break ends.
bool ends_in_line_comment(std::string_view blanks);

}  // namespace weft
