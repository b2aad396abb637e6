#include "scene/problems.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <utility>

namespace weft {
namespace {

// A longer list would hide the cause.
constexpr std::size_t max_problems = 100;
constexpr std::size_t max_quote = 60;
constexpr std::size_t max_place = 300;

constexpr bool continues_utf8(char c) {
    return (static_cast<unsigned char>(c) & 0xc0) == 0x80;
}

// Each error is one line, also where a key contains a newline.
std::string printable(std::string_view text) {
    constexpr std::string_view digits = "0123456789abcdef";
    std::string result;
    for (const char c : text) {
        if (is_control(c))
            ((result += "\\u00") += digits[(c >> 4) & 0xf]) += digits[c & 0xf];
        else
            result += c;
    }
    return result;
}

// `text`, cut to whole characters if it is longer than `limit`.
std::string shortened(std::string_view text, std::size_t limit) {
    if (text.size() <= limit) return printable(text);
    std::size_t end = limit;
    while (end > 0 && continues_utf8(text[end])) --end;
    return printable(text.substr(0, end)) + "…";
}

template <class Real>
std::string shortest(Real value) {
    if (std::isnan(value)) return "nan";
    if (std::isinf(value)) return value > 0 ? "infinity" : "-infinity";
    const Real size = std::abs(value);
    const bool plain = size == 0 || (size >= Real(1e-4) && size < Real(1e9));
    std::array<char, 64> buffer;
    // Beyond that range, large whole numbers keep their digits where an exponent would not make them shorter.
    const auto end = plain      ? std::to_chars(buffer.begin(), buffer.end(), value, std::chars_format::fixed)
                     : size < 1 ? std::to_chars(buffer.begin(), buffer.end(), value, std::chars_format::scientific)
                                : std::to_chars(buffer.begin(), buffer.end(), value);
    std::string text(buffer.data(), end.ptr);
    if (const std::size_t e = text.find('e'); e != std::string::npos) {
        const std::string exponent = std::to_string(std::stoi(text.substr(e + 1)));
        text.replace(e + 1, std::string::npos, exponent);
    }
    return text;
}

}  // namespace

std::string at(std::string_view pointer, std::string_view key) {
    std::string result(pointer);
    result += '/';
    for (const char c : key) {
        if (c == '~')
            result += "~0";
        else if (c == '/')
            result += "~1";
        else
            result += c;
    }
    return result;
}

std::string at(std::string_view pointer, std::size_t index) {
    return std::string(pointer) + '/' + std::to_string(index);
}

std::string number_text(float value) {
    return shortest(value);
}

std::string number_text(double value) {
    return shortest(value);
}

std::string number_text(std::uint32_t value) {
    return std::to_string(value);
}

std::string in_quotes(std::string_view text) {
    return '"' + shortened(text, max_quote) + '"';
}

void Problems::add(std::string where, std::string what) {
    if (earlier_ && earlier_->concern(where)) return;
    if (errors_.size() < max_problems)
        errors_.push_back({shortened(where, max_place), std::move(what)});
    else
        ++left_out_;
}

void Problems::append(Problems&& later) {
    for (Error& error : later.errors_) add(std::move(error.where), std::move(error.what));
    left_out_ += later.left_out_;
}

bool Problems::concern(std::string_view pointer) const {
    if (earlier_ && earlier_->concern(pointer)) return true;
    const auto within = [](std::string_view inner, std::string_view outer) {
        return inner.starts_with(outer) && (inner.size() == outer.size() || inner[outer.size()] == '/');
    };
    return std::ranges::any_of(
        errors_, [&](const Error& error) { return within(error.where, pointer) || within(pointer, error.where); });
}

Errors Problems::take(std::string_view name) && {
    if (left_out_ > 0) errors_.push_back({"", "and " + std::to_string(left_out_) + " more"});
    if (!name.empty())
        for (Error& error : errors_) error.where = std::string(name) + (error.where.empty() ? "" : ": ") + error.where;
    return std::move(errors_);
}

Errors within(const std::string& place, const Errors& errors) {
    Errors placed;
    for (const Error& error : errors) placed.push_back({place, error.message(), error.fault});
    return placed;
}

}  // namespace weft
