// Collects all problems of one input, so that they are reported together.
#pragma once

#include <weft/result.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace weft {

/// Appends a key or an index to the JSON pointer (RFC 6901) `pointer`.
std::string at(std::string_view pointer, std::string_view key);
std::string at(std::string_view pointer, std::size_t index);

/// The fewest digits that read back as the same number; with an exponent only below 1e-4 and from 1e9 on.
std::string number_text(float value);
std::string number_text(double value);
std::string number_text(std::uint32_t value);

/// Whether `c` cannot be printed on a line of text.
constexpr bool is_control(char c) {
    return static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
}

/// `text` in quotes, on one line, shortened if it is long.
std::string in_quotes(std::string_view text);

class Problems {
  public:
    Problems() = default;
    /// For a second check of the same input: places where `earlier` has problems are not reported again, because they
    /// may follow from those. `earlier` must outlive this.
    explicit Problems(const Problems* earlier) : earlier_(earlier) {}

    void add(std::string where, std::string what);
    void append(Problems&& later);

    bool none() const { return errors_.empty(); }
    /// Whether there is a problem at `pointer`, above it or below it, in this or in `earlier`.
    bool concern(std::string_view pointer) const;

    /// All problems in the order in which they were found; after the first hundred only their count. `name` is put
    /// before each place: `scenes/flag.json: /cloths/0`.
    Errors take(std::string_view name = {}) &&;

  private:
    const Problems* earlier_ = nullptr;
    Errors errors_;
    std::size_t left_out_ = 0;
};

/// The errors with `where` set to a place in the scene, and their own `where` in the text.
Errors within(const std::string& place, const Errors& errors);

}  // namespace weft
