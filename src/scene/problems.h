// Everything that is wrong with one input, gathered so that it can be reported in one go.
#pragma once

#include <weft/result.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace weft {

/// JSON pointer (RFC 6901) of a member or an element of what `pointer` names.
std::string at(std::string_view pointer, std::string_view key);
std::string at(std::string_view pointer, std::size_t index);

/// A number as a person writes it: the fewest digits that give it back, exponents only where they help.
std::string number_text(float value);
std::string number_text(double value);
std::string number_text(std::uint32_t value);

/// Nothing to print on a line of text.
constexpr bool is_control(char c) {
    return static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
}

/// In quotes, on one line, cut where it grows long.
std::string in_quotes(std::string_view text);

class Problems {
  public:
    Problems() = default;
    /// For a later look at the same input: what `earlier` problems concern is not reported again, as it may well be
    /// their consequence. `earlier` must outlive this.
    explicit Problems(const Problems* earlier) : earlier_(earlier) {}

    void add(std::string where, std::string what);
    void append(Problems&& later);

    bool none() const { return errors_.empty(); }
    /// Whether something is wrong at `pointer`, around it or inside it; asks the earlier ones too.
    bool concern(std::string_view pointer) const;

    /// All of them, in the order of their discovery; past the first hundred only their count. `name` goes before each
    /// place: `scenes/flag.json: /cloths/0`.
    Errors take(std::string_view name = {}) &&;

  private:
    const Problems* earlier_ = nullptr;
    Errors errors_;
    std::size_t left_out_ = 0;
};

}  // namespace weft
