#include "io/meshes/obj_source.h"

#include "io/meshes/words.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>

namespace weft {
namespace {

// A line number is stored in two channels, because a float holds integers exactly only up to 2^24.
constexpr std::uint32_t tag_base = 1u << 20;

std::optional<float> to_float(std::string_view word) {
    if (word.starts_with('+')) word.remove_prefix(1);
    const char* const end = word.data() + word.size();
    float value = 0;
    auto parsed = std::from_chars(word.data(), end, value);
    if (parsed.ec == std::errc::result_out_of_range) {  // underflow gives zero, overflow infinity
        double wide = word.find_first_of("eE") + 1 == word.find('-', 1) ? 0 : HUGE_VAL;  // kept if beyond a double too
        parsed = std::from_chars(word.data(), end, wide);
        value = static_cast<float>(wide);
    }
    if (parsed.ptr != end || word.empty()) return std::nullopt;
    return value;
}

/// Reads lines: joins those that end in a backslash and removes comments.
class ObjLines {
  public:
    explicit ObjLines(std::string_view text) : rest_(text) {}

    bool next(std::string_view& line) {
        if (!physical(line)) return false;
        if (!is_geometry(line) || !line.ends_with('\\')) return true;
        joined_.clear();
        while (line.ends_with('\\')) {
            joined_.append(line.substr(0, line.size() - 1)).push_back(' ');
            if (!physical(line)) line = {};
        }
        joined_.append(line);
        line = joined_;
        return true;
    }
    std::size_t number() const { return number_; }

    /// In comments and material names a backslash at the end may be part of a path and continues nothing.
    static bool is_geometry(std::string_view line) { return !line.empty() && (line[0] == 'v' || line[0] == 'f'); }

  private:
    bool physical(std::string_view& line) {
        if (rest_.empty()) return false;
        ++number_;
        const std::size_t end = rest_.find('\n');
        line = rest_.substr(0, end);
        rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
        line = line.substr(0, line.find('#'));
        while (!line.empty() && is_blank(line.front())) line.remove_prefix(1);
        while (!line.empty() && is_blank(line.back())) line.remove_suffix(1);
        return true;
    }

    std::string_view rest_;
    std::string joined_;
    std::size_t number_ = 0;
};

class ObjReader {
  public:
    ObjReader(std::string_view text, const std::string& file) : lines_(text), file_(file) {
        source_.tagged.reserve(text.size() + text.size() / 4);
    }

    Result<ObjSource> read() {
        std::string_view line;
        while (lines_.next(line)) {
            if (!ObjLines::is_geometry(line)) continue;
            std::string_view rest = line;
            const std::string_view keyword = next_word(rest);
            if (keyword == "v" && !add_vertex(rest)) return error();
            if (keyword == "vt" && !add_uv(rest)) return error();
            if (keyword == "vn" && !add_normal(rest)) return error();
            if (keyword == "f" && !add_face(rest)) return error();
        }
        if (!faces_) return Error{file_, "has no triangles"};
        // Faces may precede the vertices that they use, so their indices are checked at the end.
        for (std::size_t kind = 0; kind < 3; ++kind) {
            const Use& use = largest_[kind];
            if (use.index > counts_[kind]) {
                missing(kind, std::to_string(use.index), use.line);
                return error();
            }
        }
        return std::move(source_);
    }

  private:
    struct Use {
        std::uint64_t index = 0;
        std::size_t line = 0;
    };

    struct Numbers {
        std::array<float, 7> values{};
        std::size_t count = 0;
    };

    std::optional<Numbers> read_numbers(std::string_view rest) {
        Numbers numbers;
        for (std::string_view word = next_word(rest); !word.empty(); word = next_word(rest)) {
            if (numbers.count == numbers.values.size()) {
                fail("more than 7 numbers");
                return std::nullopt;
            }
            const std::optional<float> number = to_float(word);
            if (!number) {
                fail("'" + std::string(word.substr(0, 40)) + "' is not a number");
                return std::nullopt;
            }
            numbers.values[numbers.count++] = *number;
        }
        return numbers;
    }

    /// x y z, then w or red green blue [alpha].
    bool add_vertex(std::string_view rest) {
        const std::optional<Numbers> numbers = read_numbers(rest);
        if (!numbers) return false;
        const auto& value = numbers->values;
        const auto index = static_cast<std::uint32_t>(counts_[0]++);
        if (numbers->count < 3) return fail("a vertex needs three numbers, got " + std::to_string(numbers->count));
        if (!std::ranges::all_of(value, [](float v) { return std::isfinite(v); })) {
            return fail("vertex " + std::to_string(index) + " is not finite");
        }
        source_.positions.push_back({value[0], value[1], value[2]});
        if (numbers->count >= 6) {
            source_.colors.resize(index, {1, 1, 1, 1});
            source_.colors.push_back({value[3], value[4], value[5], numbers->count == 7 ? value[6] : 1});
        } else if (!source_.colors.empty()) {
            source_.colors.push_back({1, 1, 1, 1});
        }
        append_word("v");
        for (std::size_t i = 0; i < 3; ++i) append_number(value[i]);
        append_number(index % tag_base);
        append_number(index / tag_base);
        append_number(0);
        source_.tagged.push_back('\n');
        return true;
    }

    bool add_uv(std::string_view rest) {
        const std::optional<Numbers> numbers = read_numbers(rest);
        if (!numbers) return false;
        if (!std::isfinite(numbers->values[0]) || !std::isfinite(numbers->values[1])) {
            return fail("texture coordinate " + std::to_string(counts_[1]) + " is not finite");
        }
        ++counts_[1];
        append_word("vt");
        for (std::size_t i = 0; i < 2; ++i) append_number(numbers->values[i]);
        source_.tagged.push_back('\n');
        return true;
    }

    /// Normals can be computed from the triangles, so an invalid one becomes zero and does not reject the file.
    bool add_normal(std::string_view rest) {
        const std::optional<Numbers> numbers = read_numbers(rest);
        if (!numbers) return false;
        ++counts_[2];
        append_word("vn");
        for (std::size_t i = 0; i < 3; ++i) {
            append_number(std::isfinite(numbers->values[i]) ? numbers->values[i] : 0.0f);
        }
        source_.tagged.push_back('\n');
        return true;
    }

    bool add_face(std::string_view rest) {
        append_word("f");
        for (std::string_view word = next_word(rest); !word.empty(); word = next_word(rest)) {
            if (!check_corner(word)) return false;
            append_word(word);
        }
        source_.tagged.push_back('\n');
        faces_ = true;
        return true;
    }

    /// `v`, `v/vt`, `v//vn` or `v/vt/vn`; numbers from 1, negative ones count back from the latest line.
    bool check_corner(std::string_view word) {
        const char* at = word.data();
        const char* const end = at + word.size();
        for (std::size_t kind = 0; kind < 3; ++kind) {
            if (at < end && *at != '/') {
                std::int64_t index = 0;
                const auto parsed = std::from_chars(at, end, index);
                if (parsed.ec != std::errc{}) return malformed(word);
                at = parsed.ptr;
                if (index == 0 || index < -static_cast<std::int64_t>(counts_[kind])) {
                    return missing(kind, std::to_string(index), lines_.number());
                }
                const auto positive = static_cast<std::uint64_t>(index < 0 ? 0 : index);
                if (positive > largest_[kind].index) largest_[kind] = {positive, lines_.number()};
            } else if (kind == 0) {
                return malformed(word);
            }
            if (at == end) return true;
            if (*at++ != '/') return malformed(word);
        }
        return malformed(word);
    }

    void append_word(std::string_view word) { source_.tagged.append(word).push_back(' '); }

    template <class T>
    void append_number(T number) {
        std::array<char, 32> digits;
        const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr;
        append_word({digits.data(), end});
    }

    bool fail(std::string what) {
        what_ = std::move(what);
        line_ = lines_.number();
        return false;
    }
    bool malformed(std::string_view word) {
        return fail("'" + std::string(word.substr(0, 40)) + "' is not a corner of a face");
    }
    bool missing(std::size_t kind, const std::string& index, std::size_t line) {
        constexpr std::array<const char*, 3> kinds{"vertices", "texture coordinates", "normals"};
        what_ = "a face uses number " + index + " of " + std::to_string(counts_[kind]) + " " + kinds[kind];
        line_ = line;
        return false;
    }
    Error error() const { return {file_, "line " + std::to_string(line_) + ": " + what_}; }

    ObjLines lines_;
    std::string file_;
    ObjSource source_;
    std::array<std::uint64_t, 3> counts_{};  // v, vt, vn lines so far
    std::array<Use, 3> largest_{};           // and the largest number that a face uses
    bool faces_ = false;
    std::string what_;
    std::size_t line_ = 0;
};

}  // namespace

Result<ObjSource> read_obj_source(std::string_view text, const std::string& file) {
    return ObjReader(text, file).read();
}

std::uint32_t obj_vertex_from_tag(float red, float green) {
    return static_cast<std::uint32_t>(red) + static_cast<std::uint32_t>(green) * tag_base;
}

}  // namespace weft
