// Writes JSON values as text that people can read and edit.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace weft {

/// The keys of an object in the order in which JsonNode::of() writes them.
std::vector<std::string> keys_in_order(const nlohmann::json& object);

/// A value to write: an object that keeps the order of its keys, a list, or the finished text of any other value.
class JsonNode {
  public:
    static JsonNode object() { return JsonNode(Kind::object); }
    static JsonNode list() { return JsonNode(Kind::list); }
    /// The fewest digits that the reader converts to the same bits. `value` must be finite.
    static JsonNode number(float value);
    static JsonNode number(std::uint32_t value);
    static JsonNode flag(bool value);
    /// Nothing if the bytes are not UTF-8, which JSON requires.
    static std::optional<JsonNode> text(std::string_view value);
    /// Any value, with the keys of new scene objects in the order of docs/scene.md. Nothing if it holds text that is
    /// not UTF-8.
    static std::optional<JsonNode> of(const nlohmann::json& value);

    void add(std::string_view key, JsonNode value) {
        value.key_ = key;
        children_.push_back(std::move(value));
    }
    void add(JsonNode value) { children_.push_back(std::move(value)); }

    bool empty() const { return children_.empty(); }

    /// Puts a value on one line if it fits; longer lists of numbers fill lines. Ends in a newline.
    std::string pretty() const;
    /// The same for a value within a text: `indent` is the indentation of its line, `used` the column at which it
    /// begins. No newline at the end.
    std::string pretty(std::size_t indent, std::size_t used) const;
    /// The whole value on one line.
    std::string line() const;

  private:
    enum class Kind { object, list, scalar };
    explicit JsonNode(Kind kind) : kind_(kind) {}
    std::size_t line_length(std::size_t limit) const;
    void append_line(std::string& out) const;
    void append(std::string& out, std::size_t indent, std::size_t used) const;
    void append_filled(std::string& out, std::size_t indent) const;

    Kind kind_;
    std::string key_ = {};  ///< of an object's member
    std::string scalar_ = {};
    std::vector<JsonNode> children_ = {};
};

}  // namespace weft
