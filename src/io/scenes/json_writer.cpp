#include "io/scenes/json_writer.h"

#include "scene/problems.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

namespace weft {
namespace {

constexpr std::size_t line_width = 110;
constexpr std::size_t indentation = 4;

float read_back(const std::string& text) {
    double value = 0;
    std::from_chars(text.data(), text.data() + text.size(), value);
    return static_cast<float>(value);
}

std::string in_json(std::string_view text) {
    return nlohmann::json(text).dump();
}

// Keys that begin an object of a scene, in their order. All others follow in the order of the alphabet.
constexpr std::array<std::string_view, 20> first_keys{
    "weft", "name",      "kind",   "preset",   "time",     "a",        "b",    "cloth",   "mesh",           "plane",
    "box",  "transform", "fabric", "material", "position", "rotation", "size", "tearing", "self_collision", "pins"};

}  // namespace

std::vector<std::string> keys_in_order(const nlohmann::json& object) {
    std::vector<std::string> keys;
    for (const auto& [key, value] : object.items()) keys.push_back(key);
    std::ranges::stable_sort(keys, {}, [](const std::string& key) { return std::ranges::find(first_keys, key); });
    return keys;
}

JsonNode JsonNode::number(float value) {
    JsonNode node(Kind::scalar);
    // JSON readers take "-0" for an integer, which loses the sign.
    node.scalar_ = value == 0 && std::signbit(value) ? "-0.0" : number_text(value);
    // The reader converts through double, which may round differently if the digits of a float end halfway.
    if (read_back(node.scalar_) != value) node.scalar_ = number_text(static_cast<double>(value));
    return node;
}

JsonNode JsonNode::number(std::uint32_t value) {
    JsonNode node(Kind::scalar);
    node.scalar_ = std::to_string(value);
    return node;
}

JsonNode JsonNode::flag(bool value) {
    JsonNode node(Kind::scalar);
    node.scalar_ = value ? "true" : "false";
    return node;
}

std::optional<JsonNode> JsonNode::text(std::string_view value) {
    JsonNode node(Kind::scalar);
    try {
        node.scalar_ = in_json(value);
    } catch (const nlohmann::json::type_error&) {
        return {};
    }
    return node;
}

std::optional<JsonNode> JsonNode::of(const nlohmann::json& value) {
    if (value.is_string()) return text(value.get_ref<const std::string&>());
    if (!value.is_structured()) {
        JsonNode node(Kind::scalar);
        const bool real = value.is_number_float();
        const double number = real ? value.get<double>() : 0;
        if (real && !std::isfinite(number)) return {};
        node.scalar_ = !real ? value.dump() : number == 0 && std::signbit(number) ? "-0.0" : number_text(number);
        return node;
    }
    JsonNode node(value.is_object() ? Kind::object : Kind::list);
    const auto add_child = [&](std::string key, const nlohmann::json& child) {
        auto made = of(child);
        if (!made || !text(key)) return false;
        made->key_ = std::move(key);
        node.children_.push_back(std::move(*made));
        return true;
    };
    if (value.is_object()) {
        for (std::string& key : keys_in_order(value)) {
            const nlohmann::json& child = value[key];
            if (!add_child(std::move(key), child)) return {};
        }
    } else {
        for (const nlohmann::json& child : value)
            if (!add_child({}, child)) return {};
    }
    return node;
}

std::string JsonNode::pretty(std::size_t indent, std::size_t used) const {
    std::string out;
    if (children_.empty())
        append_line(out);
    else
        append(out, indent, used);
    return out;
}

std::string JsonNode::line() const {
    std::string out;
    append_line(out);
    return out;
}

std::string JsonNode::pretty() const {
    std::string out;
    append(out, 0, line_width);  // the outermost object always spans several lines
    return out + '\n';
}

// The length of the whole value in one line; beyond `limit`, any number above it.
std::size_t JsonNode::line_length(std::size_t limit) const {
    if (kind_ == Kind::scalar) return scalar_.size();
    std::size_t length = kind_ == Kind::object ? 4 : 2;
    for (const JsonNode& child : children_) {
        if (length > limit) break;
        length += 2 + child.line_length(limit);
        if (kind_ == Kind::object) length += in_json(child.key_).size() + 2;
    }
    return length;
}

void JsonNode::append_line(std::string& out) const {
    if (kind_ == Kind::scalar) {
        out += scalar_;
        return;
    }
    if (children_.empty()) {
        out += kind_ == Kind::object ? "{}" : "[]";
        return;
    }
    out += kind_ == Kind::object ? "{ " : "[";
    for (const JsonNode& child : children_) {
        if (&child != &children_.front()) out += ", ";
        if (kind_ == Kind::object) out += in_json(child.key_) + ": ";
        child.append_line(out);
    }
    out += kind_ == Kind::object ? " }" : "]";
}

// Fills lines, because pins may have thousands of indices.
void JsonNode::append_filled(std::string& out, std::size_t indent) const {
    std::size_t column = line_width;
    for (const JsonNode& child : children_) {
        if (column + 2 + child.scalar_.size() > line_width) {
            if (&child != &children_.front()) out += ',';
            (out += '\n').append(indent, ' ');
            column = indent;
        } else {
            out += ", ";
            column += 2;
        }
        out += child.scalar_;
        column += child.scalar_.size();
    }
}

// `used`: characters already in the line.
void JsonNode::append(std::string& out, std::size_t indent, std::size_t used) const {
    if (kind_ == Kind::scalar || used + line_length(line_width) <= line_width) return append_line(out);
    const std::size_t inner = indent + indentation;
    out += kind_ == Kind::object ? '{' : '[';
    const bool scalars =
        std::ranges::all_of(children_, [](const JsonNode& child) { return child.kind_ == Kind::scalar; });
    if (kind_ == Kind::list && scalars) {
        append_filled(out, inner);
    } else {
        for (const JsonNode& child : children_) {
            if (&child != &children_.front()) out += ',';
            (out += '\n').append(inner, ' ');
            const std::string key = kind_ == Kind::object ? in_json(child.key_) + ": " : "";
            out += key;
            child.append(out, inner, inner + key.size() + 1);
        }
    }
    (out += '\n').append(indent, ' ');
    out += kind_ == Kind::object ? '}' : ']';
}

}  // namespace weft
