#include "io/scenes/scene_text_edit.h"

#include "io/scenes/json_match.h"
#include "io/scenes/json_pieces.h"
#include "io/scenes/json_text.h"
#include "io/scenes/json_writer.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>
#include <vector>

namespace weft {
namespace {

using nlohmann::json;

constexpr std::size_t max_columns = 120;
constexpr std::size_t tab_columns = 4;
constexpr std::string_view break_characters = "\r\n";

std::size_t columns_of(std::string_view line) {
    std::size_t columns = 0;
    for (const char c : line)
        if ((static_cast<unsigned char>(c) & 0xc0) != 0x80) columns += c == '\t' ? tab_columns : 1;
    return columns;
}

std::string_view leading_blanks(std::string_view line) {
    return line.substr(0, std::min(line.find_first_not_of(" \t"), line.size()));
}

std::string_view without_leading_blanks(std::string_view text) {
    return text.substr(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
}

bool has_comment(std::string_view blanks) {
    return blanks.find('/') != blanks.npos;
}

bool has_break(std::string_view blanks) {
    return !line_breaks(blanks).empty();
}

bool starts_with_break(std::string_view text) {
    return !text.empty() && break_characters.find(text.front()) != break_characters.npos;
}

/// The last line break and the indentation after it, without comments.
std::string_view last_break(std::string_view blanks) {
    const std::string_view rest = blanks.substr(line_breaks(blanks).back());
    const std::size_t text = std::min(rest.find_first_not_of(break_characters), rest.size());
    return rest.substr(0, text + leading_blanks(rest.substr(text)).size());
}

/// One member of the changed container.
struct Item {
    const JsonPiece* piece = nullptr;  ///< null: new
    const json* from = nullptr;
    const json* to = nullptr;  ///< null: removed
    std::string key = {};      ///< of a new member, in JSON
};

enum class Layout {
    kept,
    one_per_line,  ///< of a container that was on one line
    new_lines,     ///< only new members, below the first one
};

/// Appends the changed text to out().
class TextChange {
  public:
    explicit TextChange(std::string_view source);

    void append(std::string_view text) { out_ += text; }
    /// `value`: a part of the source.
    void change(std::string_view value, const json& from, const json& to);
    bool failed() const { return failed_; }
    std::string take() { return std::move(out_); }

  private:
    struct Container {
        JsonPieces parts;
        std::vector<Item> items;
        bool all_break = false, some_break = false;  ///< members that begin a line
        std::string_view break_lead;                 ///< of such a member
        std::string base;                            ///< indentation of the line with the opening bracket
        std::size_t first_column = 0;
    };
    /// What was written between the members.
    struct Between {
        bool first = true;                     ///< no member yet
        bool line_comment = false;             ///< a line break must follow
        std::optional<std::string> lead = {};  ///< of a removed member, for the next one
    };

    void change_members(std::string_view value, const json& from, const json& to);
    std::vector<Item> items_of(const JsonPieces& parts, const json& from, const json& to);
    void write(const Container& container, char open, Layout layout);
    void write_item(const Container& container, const Item& item, bool last, Layout layout, Between& between);
    std::string lead_of_kept(const Container& container, const Item& item, Layout layout, const Between& between) const;
    std::string lead_of_new(const Container& container, const Item& item, Layout layout, const Between& between) const;
    void drop(const Container& container, std::size_t index, Between& between);
    void put(const json& value, bool one_line);

    std::string_view line() const;  ///< the last line of what was written
    std::string_view rest_of_source_line(std::string_view value) const;
    std::size_t source_columns(std::string_view value) const;
    bool too_long(std::size_t mark, std::string_view value) const;

    std::string_view source_;
    std::string newline_ = "\n", step_ = "    ";
    std::string out_;
    bool failed_ = false;
};

TextChange::TextChange(std::string_view source) : source_(source) {
    const std::size_t first = source.find_first_of(break_characters);
    if (first != source.npos && source[first] == '\r')
        newline_ = source.substr(first).starts_with("\r\n") ? "\r\n" : "\r";
    const std::string_view root = json_value_in(source);
    if (!root.starts_with('{')) return;
    const JsonPieces parts = json_pieces(root);
    if (parts.pieces.empty() || !has_break(parts.pieces[0].lead)) return;
    const std::string_view indent = last_break(parts.pieces[0].lead);
    if (const std::size_t i = indent.find_first_not_of(break_characters); i != indent.npos) step_ = indent.substr(i);
}

std::string_view TextChange::line() const {
    return std::string_view(out_).substr(out_.find_last_of(break_characters) + 1);  // npos + 1 is 0
}

std::string_view TextChange::rest_of_source_line(std::string_view value) const {
    const auto begin = static_cast<std::size_t>(value.data() - source_.data()) + value.size();
    return source_.substr(begin, source_.find_first_of(break_characters, begin) - begin);
}

/// The length of the line in which the value begins.
std::size_t TextChange::source_columns(std::string_view value) const {
    const auto begin = static_cast<std::size_t>(value.data() - source_.data());
    const std::size_t line_begin = source_.substr(0, begin).find_last_of(break_characters) + 1;
    return columns_of(source_.substr(line_begin, source_.find_first_of(break_characters, begin) - line_begin));
}

bool TextChange::too_long(std::size_t mark, std::string_view value) const {
    const std::string_view all = out_, rest = rest_of_source_line(value);  // a comment at its end may exceed the limit
    std::size_t begin = all.substr(0, mark).find_last_of(break_characters) + 1;
    for (;;) {
        const std::size_t end = all.find_first_of(break_characters, begin);
        const std::size_t more = end == all.npos ? columns_of(rest.substr(0, rest.find("//"))) : 0;
        if (columns_of(all.substr(begin, end - begin)) + more > max_columns) return true;
        if (end == all.npos) return false;
        begin = end + 1;
    }
}

void TextChange::change(std::string_view value, const json& from, const json& to) {
    if (from == to)
        out_ += value;
    else if ((from.is_object() && to.is_object()) || (from.is_array() && to.is_array()))
        change_members(value, from, to);
    else
        put(to, value.find_first_of(break_characters) == value.npos && source_columns(value) > max_columns);
}

void TextChange::put(const json& value, bool one_line) {
    const auto node = JsonNode::of(value);
    if (!node) {
        failed_ = true;
        return;
    }
    const std::string indent(leading_blanks(line()));
    const std::size_t indent_columns = columns_of(indent);
    std::string text = one_line ? node->line() : node->pretty(indent_columns, columns_of(line()));
    // The writer's indentation becomes that of this file.
    constexpr std::size_t writer_step = 4;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] != '\n') {
            out_ += text[i];
            continue;
        }
        out_ += newline_ + indent;
        std::size_t blanks = leading_blanks(std::string_view(text).substr(i + 1)).size();
        i += blanks;
        for (blanks -= std::min(blanks, indent_columns); blanks >= writer_step; blanks -= writer_step) out_ += step_;
        out_.append(blanks, ' ');
    }
}

std::vector<Item> TextChange::items_of(const JsonPieces& parts, const json& from, const json& to) {
    std::vector<Item> items;
    if (from.is_array()) {
        for (const JsonMatch& match : match_lists(from, to))
            items.push_back({match.from ? &parts.pieces[*match.from] : nullptr,
                             match.from ? &from[*match.from] : nullptr, match.to ? &to[*match.to] : nullptr});
        return items;
    }
    for (const JsonPiece& piece : parts.pieces) {
        const auto key = json::parse(piece.key).get<std::string>();
        const auto kept = to.find(key);
        items.push_back({&piece, &from.at(key), kept == to.end() ? nullptr : &*kept});
    }
    std::string_view colon = ": ";
    if (!parts.pieces.empty() && !has_comment(parts.pieces[0].colon) && !has_break(parts.pieces[0].colon))
        colon = parts.pieces[0].colon;
    for (const std::string& key : keys_in_order(to)) {
        if (from.contains(key)) continue;
        const auto text = JsonNode::text(key);
        failed_ = failed_ || !text;
        items.push_back({nullptr, nullptr, &to[key], (text ? text->line() : "") + std::string(colon)});
    }
    return items;
}

void TextChange::change_members(std::string_view value, const json& from, const json& to) {
    Container container;
    container.parts = json_pieces(value);
    const JsonPieces& parts = container.parts;
    if (parts.pieces.empty() && !has_comment(parts.open_tail) && !has_comment(parts.close))
        return put(to, source_columns(value) > max_columns);
    if (parts.pieces.size() != from.size()) {
        failed_ = true;
        return;
    }
    container.items = items_of(parts, from, to);
    container.all_break = !parts.pieces.empty();
    for (const JsonPiece& piece : parts.pieces) {
        const bool breaks = has_break(piece.lead);
        const bool on_bracket_line = &piece == &parts.pieces.front() && parts.pieces.size() > 1;
        container.some_break = container.some_break || breaks;
        container.all_break = container.all_break && (breaks || on_bracket_line);
        if (breaks) container.break_lead = last_break(piece.lead);
    }
    container.base = leading_blanks(line());
    container.first_column = columns_of(line()) + 1;

    const std::size_t mark = out_.size();
    write(container, value.front(), Layout::kept);
    const bool on_one_line = !parts.pieces.empty() && !container.some_break && !has_break(parts.close);
    const bool adds = std::ranges::any_of(container.items, [](const Item& item) { return !item.piece; });
    if (!on_one_line || !adds || source_columns(value) > max_columns || !too_long(mark, value)) return;
    const bool nested = std::ranges::any_of(parts.pieces, [](const JsonPiece& piece) {
        return piece.value.find_first_of(break_characters) != piece.value.npos;
    });
    out_.resize(mark);
    write(container, value.front(), nested ? Layout::new_lines : Layout::one_per_line);
}

void TextChange::write(const Container& container, char open, Layout layout) {
    const JsonPieces& parts = container.parts;
    out_ += open;
    const std::size_t inside = out_.size();
    out_ += parts.open_tail;
    const bool was_empty = parts.pieces.empty();  // but for comments
    if (was_empty) out_ += parts.close.substr(0, parts.close.find_last_not_of(" \t\r\n") + 1);
    Between between{.line_comment = ends_in_line_comment(std::string_view(out_).substr(inside))};
    std::size_t last = 0;
    for (std::size_t i = 0; i < container.items.size(); ++i)
        if (container.items[i].to) last = i;
    for (std::size_t i = 0; i < container.items.size(); ++i) {
        if (container.items[i].to)
            write_item(container, container.items[i], i == last, layout, between);
        else
            drop(container, i, between);
    }
    if (between.first && !has_comment(std::string_view(out_).substr(inside))) {
        out_.resize(inside);
    } else {
        const bool own_line = was_empty || layout == Layout::one_per_line;
        if (own_line || (between.line_comment && !starts_with_break(parts.close))) out_ += newline_ + container.base;
        if (!own_line) out_ += parts.close;
    }
    out_ += open == '{' ? '}' : ']';
}

void TextChange::write_item(const Container& container, const Item& item, bool last, Layout layout, Between& between) {
    std::string lead =
        item.piece ? lead_of_kept(container, item, layout, between) : lead_of_new(container, item, layout, between);
    if (between.line_comment && !starts_with_break(lead))
        lead = newline_ + container.base + step_ + std::string(without_leading_blanks(lead));
    out_ += lead;
    between = {.first = false};
    if (item.piece) {
        (out_ += item.piece->key) += item.piece->colon;
        change(item.piece->value, *item.from, *item.to);
        out_ += item.piece->before_comma;
    } else {
        out_ += item.key;
        // On the line of other members; too long a line gets another layout.
        put(*item.to, layout == Layout::kept && !container.parts.pieces.empty() && !has_break(lead));
    }
    if (!last) out_ += ',';
    if (!item.piece) return;
    out_ += item.piece->tail;
    between.line_comment = ends_in_line_comment(item.piece->tail);
}

std::string TextChange::lead_of_kept(const Container& container, const Item& item, Layout layout,
                                     const Between& between) const {
    const std::string_view lead = item.piece->lead;
    if (layout == Layout::one_per_line)
        return newline_ + container.base + step_ + std::string(without_leading_blanks(lead));
    if (has_break(lead)) return std::string(lead);
    const std::string rest(without_leading_blanks(lead));
    if (between.lead) return *between.lead + rest;
    const bool was_first = item.piece == &container.parts.pieces.front();
    if (!was_first || between.first) return std::string(lead);
    return (container.some_break ? std::string(container.break_lead) : " ") + rest;
}

std::string TextChange::lead_of_new(const Container& container, const Item& item, Layout layout,
                                    const Between& between) const {
    const std::vector<JsonPiece>& pieces = container.parts.pieces;
    if (layout == Layout::one_per_line || pieces.empty()) return newline_ + container.base + step_;
    if (layout == Layout::new_lines && !between.first)
        return newline_ + container.base + std::string(container.first_column - columns_of(container.base), ' ');
    if (between.lead && (between.first || has_break(*between.lead))) return *between.lead;
    if (between.first && !has_break(pieces[0].lead))
        return has_comment(pieces[0].lead) ? " " : std::string(pieces[0].lead);
    if (container.all_break) return std::string(container.break_lead);
    if (container.some_break) {
        const auto node = JsonNode::of(*item.to);
        const std::size_t more =
            node ? columns_of(item.key) + columns_of(node->line()) + 3 : 0;  // blank, comma, bracket
        if (columns_of(line()) + more > max_columns) return std::string(container.break_lead);
    }
    const bool has_example = pieces.size() > 1 && !has_comment(pieces[1].lead) && !has_break(pieces[1].lead);
    return has_example ? std::string(pieces[1].lead) : " ";
}

// Leaves a removed member out, but not the comments that belong to others.
void TextChange::drop(const Container& container, std::size_t index, Between& between) {
    const JsonPiece& piece = *container.items[index].piece;
    const JsonPiece* const next = &piece == &container.parts.pieces.back() ? nullptr : &piece + 1;
    const std::vector<std::size_t> breaks = line_breaks(piece.lead);
    std::size_t keep = 0;
    for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
        const std::string_view inside = piece.lead.substr(breaks[i], breaks[i + 1] - breaks[i]);
        if (without_leading_blanks(inside).empty() && has_comment(piece.lead.substr(0, breaks[i])))
            keep = breaks[i + 1];
    }
    // A comment above several lines of members may be about all of them.
    const bool next_stays = next && index + 1 < container.items.size() && container.items[index + 1].to;
    if (next_stays && !breaks.empty() && line_breaks(next->lead).size() == 1 && !has_comment(next->lead) &&
        has_comment(piece.lead))
        keep = breaks.back();
    const auto keep_comment = [&](std::string_view comment) {
        if (between.line_comment && !starts_with_break(comment)) out_ += newline_ + container.base + step_;
        out_ += comment;
        between.line_comment = ends_in_line_comment(comment);
    };
    if (keep > 0) keep_comment(piece.lead.substr(0, keep));
    if (!between.lead)
        between.lead = breaks.empty() ? std::string(has_comment(piece.lead) ? " " : piece.lead)
                                      : std::string(last_break(piece.lead));
    // The comment at the end of a line with other members is about those too.
    const bool ends_line = next ? has_break(next->lead) : has_break(container.parts.close);
    if (breaks.empty() && ends_line && has_comment(piece.tail)) keep_comment(piece.tail);
}

}  // namespace

Result<std::string> edit_scene_text(std::string_view text, const json& wanted) {
    Problems problems;
    const auto now = parse_json(text, problems);
    if (!now || !problems.none()) return std::move(problems).take();
    if (*now == wanted) return std::string(text);
    TextChange change(text);
    const std::string_view value = json_value_in(text);
    const auto begin = static_cast<std::size_t>(value.data() - text.data());
    change.append(text.substr(0, begin));
    change.change(value, *now, wanted);
    change.append(text.substr(begin + value.size()));
    const bool failed = change.failed();
    std::string result = change.take();
    const auto read = failed ? std::nullopt : parse_json(result, problems);
    if (!read || !problems.none() || *read != wanted)
        return Error{"", "cannot be changed in its text alone; it must be written anew"};
    return result;
}

}  // namespace weft
