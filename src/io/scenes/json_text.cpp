#include "io/scenes/json_text.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

namespace weft {
namespace {

using nlohmann::json;

std::string line_and_column(std::string_view text, std::size_t position) {
    const std::string_view before = text.substr(0, std::min(position, text.size()));
    const std::size_t line_start = before.rfind('\n') + 1;  // npos + 1 is 0
    const auto line = 1 + std::count(before.begin(), before.end(), '\n');
    const std::string_view in_line = before.substr(line_start);
    // Continuation bytes of UTF-8 do not count.
    const auto column =
        std::ranges::count_if(in_line, [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; });
    return "line " + std::to_string(line) + ", column " + std::to_string(std::max<std::ptrdiff_t>(column, 1));
}

// Extracts the middle of "[json.exception.parse_error.101] parse error at line 1, column 2: syntax error while parsing
// value - invalid literal; last read: '…'; expected …". The rest is reported already or may contain any bytes.
std::string readable(std::string_view message) {
    if (const std::size_t end = message.find("] "); message.starts_with('[') && end != message.npos)
        message.remove_prefix(end + 2);
    if (const std::size_t colon = message.find(": "); message.starts_with("parse error") && colon != message.npos)
        message.remove_prefix(colon + 2);
    std::string text(message);
    if (const std::size_t read = text.find("; last read: '"); read != text.npos) {
        const std::size_t expected = text.rfind("'; expected ");
        text.erase(read, expected == text.npos ? text.npos : expected + 1 - read);
    }
    if (const std::size_t dash = text.find(" - "); dash != text.npos) text.replace(dash, 3, ": ");
    return text;
}

// Builds the values as nlohmann's own parser would, and also checks nesting depth, number of values and repeated keys.
class Builder final : public nlohmann::json_sax<json> {
  public:
    Builder(std::string_view text, Problems& problems) : text_(text), problems_(problems) {}

    json take_root() { return std::move(root_); }

    bool null() override { return put(nullptr) != nullptr; }
    bool boolean(bool value) override { return put(value) != nullptr; }
    bool number_integer(number_integer_t value) override { return put(value) != nullptr; }
    bool number_unsigned(number_unsigned_t value) override { return put(value) != nullptr; }
    bool number_float(number_float_t value, const string_t&) override { return put(value) != nullptr; }
    bool string(string_t& value) override { return put(std::move(value)) != nullptr; }
    bool binary(binary_t&) override { return false; }  // not in text

    bool start_object(std::size_t) override { return open(json::object()); }
    bool start_array(std::size_t) override { return open(json::array()); }
    bool end_object() override { return close(); }
    bool end_array() override { return close(); }

    bool key(string_t& key) override {
        Level& level = levels_.back();
        if (level.container->contains(key)) problems_.add(at(pointer(), key), "appears twice in the same object");
        level.key = std::move(key);
        return true;
    }

    bool parse_error(std::size_t position, const std::string&, const nlohmann::detail::exception& error) override {
        // The library reports a number that is too large as a range error; here it is one more error in the text.
        problems_.add(line_and_column(text_, position), readable(error.what()));
        return false;
    }

  private:
    struct Level {
        json* container;
        string_t key = {};  ///< of the next value; unused in a list
    };

    std::string pointer() const {
        std::string result;
        for (std::size_t i = 0; i + 1 < levels_.size(); ++i)
            result = levels_[i].container->is_object() ? at(result, levels_[i].key)
                                                       : at(result, levels_[i].container->size() - 1);
        return result;
    }

    json* put(json value) {
        if (++values_ > max_json_values) {
            problems_.add("", "holds more than " + std::to_string(max_json_values) + " values");
            return nullptr;
        }
        if (levels_.empty()) return &(root_ = std::move(value));
        Level& level = levels_.back();
        if (level.container->is_object()) return &((*level.container)[level.key] = std::move(value));
        level.container->push_back(std::move(value));
        return &level.container->back();
    }

    bool open(json container) {
        if (levels_.size() >= max_json_depth) {
            problems_.add(pointer(), "is nested more than " + std::to_string(max_json_depth) + " deep");
            return false;
        }
        json* place = put(std::move(container));
        if (place) levels_.push_back({place});
        return place != nullptr;
    }

    bool close() {
        levels_.pop_back();
        return true;
    }

    std::string_view text_;
    Problems& problems_;
    json root_;
    std::vector<Level> levels_;
    std::size_t values_ = 0;
};

}  // namespace

std::optional<json> parse_json(std::string_view text, Problems& problems) {
    if (text.size() > max_json_bytes) {
        problems.add("", "is longer than " + std::to_string(max_json_bytes >> 20) + " MiB");
        return {};
    }
    if (constexpr std::string_view byte_order_mark = "\xef\xbb\xbf"; text.starts_with(byte_order_mark))
        text.remove_prefix(byte_order_mark.size());
    if (text.find_first_not_of(" \t\r\n") == text.npos) {
        problems.add("", "is empty");
        return {};
    }
    Builder builder(text, problems);
    const bool strict = true, ignore_comments = true;
    if (!json::sax_parse(text, &builder, json::input_format_t::json, strict, ignore_comments)) return {};
    return builder.take_root();
}

}  // namespace weft
