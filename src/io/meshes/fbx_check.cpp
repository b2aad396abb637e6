#include "io/meshes/mesh_checks.h"
#include "io/meshes/node_tree.h"

#include <algorithm>
#include <charconv>
#include <iterator>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

namespace weft {
namespace {

/// The node hierarchy of a file: its models, and which model is below which. Number 0 is the root.
struct Models {
    std::set<std::uint64_t> numbers;
    std::unordered_map<std::uint64_t, std::vector<std::uint64_t>> below;  ///< includes objects that are not models
};

std::string problem_of_models(const Models& models) {
    return problem_of_tree(std::vector<std::uint64_t>{0}, models.numbers.size(), [&](std::uint64_t number) {
        std::vector<std::uint64_t> children;
        if (const auto found = models.below.find(number); found != models.below.end())
            std::ranges::copy_if(found->second, std::back_inserter(children),
                                 [&](std::uint64_t child) { return models.numbers.contains(child); });
        return children;
    });
}

const std::string too_deep = "has blocks nested more than " + std::to_string(deepest_nesting) + " deep";

// Text format: `Key: value, "value", … {`, nested by braces. A semicolon begins a comment.

// A connection has three values; lists of coordinates are long.
constexpr std::size_t most_values = 3;

/// One `Key:` with its first values, without quotes.
struct Line {
    std::string_view key;
    std::vector<std::string_view> values;
};

std::uint64_t number_of(std::string_view digits) {
    std::uint64_t number = ~std::uint64_t{0};
    std::from_chars(digits.data(), digits.data() + digits.size(), number);
    return number;
}

void note(const Line& line, Models& models) {
    const auto& v = line.values;
    if (line.key == "Model" && !v.empty()) models.numbers.insert(number_of(v[0]));
    if (line.key == "C" && v.size() > 2) models.below[number_of(v[2])].push_back(number_of(v[1]));
}

std::string problem_of_text(std::string_view text) {
    Models models;
    Line line;
    std::size_t depth = 0;
    for (std::size_t i = 0; i < text.size();) {
        const std::size_t begin = i;
        const char c = text[i++];
        if (c == ';') {
            i = std::min(text.find_first_of(std::string_view("\n\r\f\0", 4), i), text.size());
        } else if (c == '"') {
            const std::size_t end = std::min(text.find('"', i), text.size());
            if (line.values.size() < most_values) line.values.push_back(text.substr(i, end - i));
            i = end + 1;
        } else if (c == '{' || c == '}') {
            note(line, models);
            line = {};
            if (c == '{' && ++depth > deepest_nesting) return too_deep;
            if (c == '}' && depth > 0) --depth;
        } else if (std::string_view(" \t\n\r\f\v,:", 8).find(c) == std::string_view::npos && c != '\0') {
            i = std::min(text.find_first_of(std::string_view(" \t\n\r\f\v,:;\"{}\0", 13), i), text.size());
            const std::string_view word = text.substr(begin, i - begin);
            if (i < text.size() && text[i] == ':') {
                note(line, models);
                line = {.key = word, .values = {}};
            } else if (line.values.size() < most_values) {
                line.values.push_back(word);
            }
        }
    }
    note(line, models);
    return problem_of_models(models);
}

// Binary format: records with their end, the number and the size of their properties, a name, and nested records, the
// last of which is empty. Blender Foundation, "FBX binary file format specification", 2013.

class BinaryWalk {
  public:
    explicit BinaryWalk(std::string_view bytes) : bytes_(bytes), wide_(number(version_at, 4) >= 7500) {}

    std::string problem() {
        std::vector<std::size_t> ends{bytes_.size()};  // of the enclosing records
        for (std::size_t at = header_size; !ends.empty();) {
            if (at >= ends.back()) {  // skips the empty record after the last nested one
                at = ends.back() + (ends.size() > 1 ? empty_size() : 0);
                ends.pop_back();
                continue;
            }
            const std::size_t end = number(at, word());
            if (end == 0 && ends.size() == 1) break;  // the records end here
            if (end == 0) {                           // Assimp reads the next record right after that zero
                at += word();
                continue;
            }
            const std::size_t name_size = number(at + 3 * word(), 1), properties = at + 3 * word() + 1 + name_size;
            const std::size_t size = number(at + 2 * word(), word());
            // Assimp stops here.
            if (end <= at || end > ends.back() || properties > end || size > end - properties) break;
            note(bytes_.substr(properties - name_size, name_size), bytes_.substr(properties, size));
            at = properties + size;
            if (at == end) continue;
            if (end - at < empty_size()) break;
            ends.push_back(end - empty_size());
            if (ends.size() > deepest_nesting) return too_deep;
        }
        return problem_of_models(models_);
    }

  private:
    static constexpr std::size_t version_at = 23, header_size = 27;

    std::size_t word() const { return wide_ ? 8 : 4; }
    std::size_t empty_size() const { return 3 * word() + 1; }

    std::uint64_t number(std::size_t at, std::size_t size) const {
        std::uint64_t value = 0;
        for (std::size_t b = 0; b < size && at + b < bytes_.size(); ++b)
            value |= std::uint64_t{static_cast<unsigned char>(bytes_[at + b])} << (8 * b);
        return value;
    }

    /// Numbers are "L" and eight bytes; a string is "S", its length in four bytes, and its bytes.
    void note(std::string_view name, std::string_view properties) {
        const auto at = static_cast<std::size_t>(properties.data() - bytes_.data());
        if (name == "Model" && properties.starts_with('L')) models_.numbers.insert(number(at + 1, 8));
        if (name != "C" || !properties.starts_with('S')) return;
        const std::size_t source = 5 + number(at + 1, 4), target = source + 9;
        if (properties.size() >= target + 9)
            models_.below[number(at + target + 1, 8)].push_back(number(at + source + 1, 8));
    }

    std::string_view bytes_;
    bool wide_;
    Models models_;
};

}  // namespace

std::string problem_of_fbx(std::string_view content) {
    return content.starts_with("Kaydara FBX Binary") ? BinaryWalk(content).problem() : problem_of_text(content);
}

}  // namespace weft
