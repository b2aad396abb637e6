#include "io/scenes/json_pieces.h"

#include <algorithm>

namespace weft {
namespace {

bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

/// The end of the comment that begins at `i`. A line break after `//` does not belong to it.
std::size_t end_of_comment(std::string_view text, std::size_t i) {
    if (text.substr(i).starts_with("/*")) {
        const std::size_t end = text.find("*/", i + 2);
        return end == text.npos ? text.size() : end + 2;
    }
    return std::min(text.find_first_of("\r\n", i), text.size());
}

std::size_t skip_blanks(std::string_view text, std::size_t i) {
    while (i < text.size() && (is_blank(text[i]) || text[i] == '/'))
        i = text[i] == '/' ? end_of_comment(text, i) : i + 1;
    return i;
}

std::size_t skip_string(std::string_view text, std::size_t i) {
    for (++i; i < text.size() && text[i] != '"'; ++i)
        if (text[i] == '\\') ++i;
    return std::min(i + 1, text.size());
}

std::size_t skip_value(std::string_view text, std::size_t i) {
    std::size_t depth = 0;
    do {
        if (i >= text.size()) return text.size();
        const char c = text[i];
        if (c == '"') {
            i = skip_string(text, i);
        } else if (c == '/') {
            i = end_of_comment(text, i);
        } else if (c == '{' || c == '[') {
            ++depth, ++i;
        } else if (c == '}' || c == ']') {
            --depth, ++i;
        } else if (depth > 0) {
            ++i;
        } else {
            return std::min(text.find_first_of(" \t\r\n,]}/", i), text.size());
        }
    } while (depth > 0);
    return i;
}

std::string_view between(std::string_view text, std::size_t begin, std::size_t end) {
    return text.substr(begin, end - begin);
}

}  // namespace

std::string_view json_value_in(std::string_view text) {
    constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
    const std::size_t begin = skip_blanks(text, text.starts_with(byte_order_mark) ? byte_order_mark.size() : 0);
    return between(text, begin, skip_value(text, begin));
}

JsonPieces json_pieces(std::string_view container) {
    const bool object = container.front() == '{';
    // The blanks from `begin` to `end`, up to the first line break.
    const auto rest_of_line = [&](std::size_t begin, std::size_t end) {
        const std::string_view blanks = between(container, begin, end);
        const auto breaks = line_breaks(blanks);
        return breaks.empty() ? std::string_view() : blanks.substr(0, breaks.front());
    };
    JsonPieces result;
    std::size_t i = skip_blanks(container, 1);
    result.open_tail = rest_of_line(1, i);
    std::size_t lead = 1 + result.open_tail.size();
    while (i + 1 < container.size()) {
        JsonPiece piece;
        piece.lead = between(container, lead, i);
        if (object) {
            const std::size_t key_end = skip_string(container, i);
            piece.key = between(container, i, key_end);
            i = skip_blanks(container, skip_blanks(container, key_end) + 1);
            piece.colon = between(container, key_end, i);
        }
        const std::size_t value_end = skip_value(container, i);
        piece.value = between(container, i, value_end);
        i = skip_blanks(container, value_end);
        if (i < container.size() && container[i] == ',') {
            piece.before_comma = between(container, value_end, i);
            lead = i + 1;
            i = skip_blanks(container, lead);
            piece.tail = rest_of_line(lead, i);
        } else {
            lead = value_end;
            const std::string_view blanks = between(container, lead, i);
            piece.tail = rest_of_line(lead, i);
            if (line_breaks(blanks).empty()) piece.tail = blanks.substr(0, blanks.find_last_not_of(" \t") + 1);
            i = container.size();
        }
        lead += piece.tail.size();
        result.pieces.push_back(piece);
    }
    result.close = between(container, lead, container.size() - 1);
    return result;
}

std::vector<std::size_t> line_breaks(std::string_view blanks) {
    std::vector<std::size_t> breaks;
    for (std::size_t i = 0; i < blanks.size();) {
        if (blanks[i] == '/') {
            i = end_of_comment(blanks, i);
            continue;
        }
        const bool two = blanks.substr(i).starts_with("\r\n");
        if (two || blanks[i] == '\n' || blanks[i] == '\r') breaks.push_back(i);
        i += two ? 2 : 1;
    }
    return breaks;
}

bool ends_in_line_comment(std::string_view blanks) {
    for (std::size_t i = 0; i < blanks.size();) {
        if (blanks[i] != '/') {
            ++i;
            continue;
        }
        const bool line = blanks.substr(i).starts_with("//");
        i = end_of_comment(blanks, i);
        if (line && i == blanks.size()) return true;
    }
    return false;
}

}  // namespace weft
