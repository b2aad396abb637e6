#include "io/meshes/mesh_checks.h"
#include "io/meshes/words.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <cstring>
#include <utility>
#include <vector>

namespace weft {
namespace {

struct Type {
    std::string_view name;
    std::size_t size;
    bool is_signed;
    bool is_integer;
};

constexpr std::array types{
    Type{"char", 1, true, true},     Type{"int8", 1, true, true},     Type{"uchar", 1, false, true},
    Type{"uint8", 1, false, true},   Type{"short", 2, true, true},    Type{"int16", 2, true, true},
    Type{"ushort", 2, false, true},  Type{"uint16", 2, false, true},  Type{"int", 4, true, true},
    Type{"int32", 4, true, true},    Type{"uint", 4, false, true},    Type{"uint32", 4, false, true},
    Type{"float", 4, true, false},   Type{"float32", 4, true, false}, Type{"double", 8, true, false},
    Type{"float64", 8, true, false},
};

struct Property {
    const Type* length = nullptr;  ///< of a list, else null
    const Type* item = nullptr;
    bool is_vertex_index = false;
};

struct Element {
    std::string name;
    std::uint64_t count = 0;
    std::vector<Property> properties;
};

enum class Encoding { ascii, little_endian, big_endian };

std::string_view next_line(std::string_view& rest) {
    const std::size_t end = rest.find('\n');
    std::string_view line = rest.substr(0, end);
    rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
    if (line.ends_with('\r')) line.remove_suffix(1);
    return line;
}

template <class T>
bool parse_whole(std::string_view word, T& value) {
    const auto parsed = std::from_chars(word.data(), word.data() + word.size(), value);
    return parsed.ec == std::errc{} && parsed.ptr == word.data() + word.size();
}

/// Whether the word is a number, finite or not.
bool is_number(std::string_view word) {
    if (word.starts_with('+')) word.remove_prefix(1);
    double value = 0;
    const auto parsed = std::from_chars(word.data(), word.data() + word.size(), value);
    return parsed.ec != std::errc::invalid_argument && parsed.ptr == word.data() + word.size();
}

/// Programs differ in whether these characters separate words.
bool has_control_character(std::string_view line) {
    return std::ranges::any_of(line, [](unsigned char c) { return (c < ' ' && c != '\t' && c != '\r') || c == 0x7f; });
}

const Type* find_type(std::string_view name) {
    for (const Type& type : types) {
        if (type.name == name) return &type;
    }
    return nullptr;
}

class PlyCheck {
  public:
    explicit PlyCheck(std::string_view content) : rest_(content) {}

    std::string run() {
        if (!read_header()) return problem_;
        for (const Element& element : elements_) {
            if (element.name == "vertex") vertex_count_ = element.count;
        }
        for (const Element& element : elements_) {
            if (!(encoding_ == Encoding::ascii ? walk_text(element) : walk_binary(element))) return problem_;
        }
        return {};
    }

  private:
    bool fail(std::string problem) {
        problem_ = std::move(problem);
        return false;
    }

    bool read_header() {
        if (next_line(rest_) != "ply") return fail("is not a PLY file");
        bool has_format = false;
        while (!rest_.empty()) {
            const std::string_view whole = next_line(rest_);
            if (has_control_character(whole)) return fail("has control characters in its header");
            std::string_view line = whole;
            const std::string_view keyword = next_word(line);
            if (keyword == "end_header") return has_format || fail("its header names no format");
            if (keyword == "format") {
                has_format = read_format(next_word(line));
                if (!has_format) return false;
            } else if (keyword == "element") {
                Element element{.name = std::string(next_word(line)), .count = 0, .properties = {}};
                if (!parse_whole(next_word(line), element.count)) return bad_line(whole);
                const bool is_second = std::ranges::find(elements_, element.name, &Element::name) != elements_.end();
                if (is_second || element.name == "tristrips") return bad_line(whole);
                elements_.push_back(std::move(element));
            } else if (keyword == "property") {
                if (!read_property(line)) return bad_line(whole);
            }  // comments, and extra lines that some programs write, such as Blender 2.4
        }
        return fail("is cut short in its header");
    }

    bool bad_line(std::string_view line) { return fail("bad header line '" + std::string(line.substr(0, 60)) + "'"); }

    bool read_format(std::string_view name) {
        if (name == "ascii")
            encoding_ = Encoding::ascii;
        else if (name == "binary_little_endian")
            encoding_ = Encoding::little_endian;
        else if (name == "binary_big_endian")
            encoding_ = Encoding::big_endian;
        else
            return fail("unknown format '" + std::string(name.substr(0, 40)) + "'");
        return true;
    }

    bool read_property(std::string_view line) {
        if (elements_.empty()) return false;
        Property property;
        std::string_view type = next_word(line);
        const bool is_list = type == "list";
        if (is_list) {
            property.length = find_type(next_word(line));
            if (!property.length || !property.length->is_integer) return false;
            type = next_word(line);
        }
        property.item = find_type(type);
        const std::string_view name = next_word(line);
        property.is_vertex_index =
            is_list && elements_.back().name == "face" && (name == "vertex_indices" || name == "vertex_index");
        elements_.back().properties.push_back(property);
        return property.item && !name.empty() && (!property.is_vertex_index || property.item->is_integer);
    }

    bool cut_short(const Element& element, std::uint64_t index) {
        return fail("is cut short at " + element.name + " " + std::to_string(index) + " of " +
                    std::to_string(element.count));
    }

    /// Assimp's triangulation aborts the program on a face without corners.
    bool no_corners(std::uint64_t face) { return fail("face " + std::to_string(face) + " has no corners"); }

    bool check_index(const Element& element, std::uint64_t face, std::int64_t index) {
        if (index >= 0 && static_cast<std::uint64_t>(index) < vertex_count_) return true;
        return fail(element.name + " " + std::to_string(face) + " uses vertex " + std::to_string(index) + " of " +
                    std::to_string(vertex_count_));
    }

    bool bad_value(const Element& element, std::uint64_t index, std::string_view word) {
        return fail("has '" + std::string(word.substr(0, 40)) + "' at " + element.name + " " + std::to_string(index));
    }

    bool walk_text(const Element& element) {
        for (std::uint64_t i = 0; i < element.count; ++i) {
            std::string_view line;
            while (line.find_first_not_of(" \t\r") == std::string_view::npos) {
                if (rest_.empty()) return cut_short(element, i);
                line = next_line(rest_);
                if (has_control_character(line)) return fail("has control characters");
            }
            for (const Property& property : element.properties) {
                if (!walk_text(element, i, property, line)) return false;
            }
            // Assimp would read further values as the next element.
            if (!next_word(line).empty()) {
                return fail("has more values than properties at " + element.name + " " + std::to_string(i));
            }
        }
        return true;
    }

    bool walk_text(const Element& element, std::uint64_t i, const Property& property, std::string_view& line) {
        std::uint64_t items = 1;
        if (property.length && !parse_whole(next_word(line), items)) return cut_short(element, i);
        if (property.is_vertex_index && items == 0) return no_corners(i);
        for (std::uint64_t k = 0; k < items; ++k) {
            const std::string_view word = next_word(line);
            if (word.empty()) return cut_short(element, i);
            if (!property.is_vertex_index) {
                if (!is_number(word)) return bad_value(element, i, word);
                continue;
            }
            std::int64_t index = 0;
            if (!parse_whole(word, index)) return bad_value(element, i, word);
            if (!check_index(element, i, index)) return false;
        }
        return true;
    }

    std::int64_t integer_at(const char* at, const Type& type) const {
        std::uint64_t value = 0;
        for (std::size_t b = 0; b < type.size; ++b) {
            const std::size_t from = encoding_ == Encoding::big_endian ? b : type.size - 1 - b;
            value = value << 8 | static_cast<unsigned char>(at[from]);
        }
        const std::uint64_t sign = 1ull << (8 * type.size - 1);
        return type.is_signed ? static_cast<std::int64_t>((value ^ sign) - sign) : static_cast<std::int64_t>(value);
    }

    bool walk_binary(const Element& element) {
        if (element.properties.empty()) return true;
        for (std::uint64_t i = 0; i < element.count; ++i) {
            for (const Property& property : element.properties) {
                std::size_t items = 1;
                if (property.length) {
                    if (rest_.size() < property.length->size) return cut_short(element, i);
                    const std::int64_t length = integer_at(rest_.data(), *property.length);
                    if (length < 0) return cut_short(element, i);
                    if (property.is_vertex_index && length == 0) return no_corners(i);
                    items = static_cast<std::size_t>(length);
                    rest_.remove_prefix(property.length->size);
                }
                if (rest_.size() / property.item->size < items) return cut_short(element, i);
                if (property.is_vertex_index) {
                    for (std::size_t k = 0; k < items; ++k) {
                        const char* const at = rest_.data() + k * property.item->size;
                        if (!check_index(element, i, integer_at(at, *property.item))) return false;
                    }
                }
                rest_.remove_prefix(items * property.item->size);
            }
        }
        return true;
    }

    std::string_view rest_;
    Encoding encoding_ = Encoding::ascii;
    std::vector<Element> elements_;
    std::uint64_t vertex_count_ = 0;
    std::string problem_;
};

}  // namespace

std::string problem_of_ply(std::string_view content) {
    return PlyCheck(content).run();
}

}  // namespace weft
