#include "editor/ui/expression.h"

#include "editor/ui/units.h"

#include <charconv>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <optional>
#include <utility>

namespace weft::editor {
namespace {

/// Signs that keyboards lack, by those that they have.
std::string plain(std::string_view text) {
    constexpr std::pair<std::string_view, std::string_view> other_signs[] = {
        {"−", "-"}, {"–", "-"}, {"×", "*"}, {"÷", "/"}, {"π", "pi"}, {"\u00a0", " "}, {"\u2009", " "}};
    std::string out;
    while (!text.empty()) {
        bool replaced = false;
        for (const auto& [from, to] : other_signs) {
            if (!text.starts_with(from)) continue;
            out += to;
            text.remove_prefix(from.size());
            replaced = true;
            break;
        }
        if (replaced) continue;
        out += text[0];
        text.remove_prefix(1);
    }
    if (out.find('.') == std::string::npos)  // 0,5
        for (char& c : out)
            if (c == ',') c = '.';
    return out;
}

class Evaluation {
  public:
    Evaluation(std::string_view text, std::string_view unit) : rest_(text), unit_(unit) {}

    double sum() {
        if (++depth_ > 64) fail("too many parentheses");
        double value = product();
        while (!error_) {
            if (skip('+')) {
                value += product();
            } else if (skip('-')) {
                value -= product();
            } else {
                break;
            }
        }
        --depth_;
        return value;
    }
    bool at_end() {
        skip_spaces();
        return rest_.empty();
    }
    std::string_view rest() const { return rest_; }
    const std::optional<std::string>& error() const { return error_; }
    void fail(std::string what) {
        if (!error_) error_ = std::move(what);
    }

  private:
    double product() {
        double value = power();
        while (!error_) {
            if (skip('*')) {
                value *= power();
            } else if (skip('/')) {
                const double by = power();
                if (by == 0) fail("division by zero");
                value /= by;
            } else {
                break;
            }
        }
        return value;
    }
    double power() {
        if (++depth_ > 64) {
            fail("too many signs");
            return 0;
        }
        double value = 0;
        if (skip('-')) {
            value = -power();
        } else if (skip('+')) {
            value = power();
        } else {
            value = operand();
            if (skip('^')) value = std::pow(value, power());
        }
        --depth_;
        return value;
    }
    double operand() {
        skip_spaces();
        if (error_) return 0;
        if (skip('(')) {
            const double value = sum();
            if (!skip(')')) fail("a closing parenthesis is missing");
            return with_unit(value);
        }
        if (skip_word("pi")) return std::numbers::pi;
        if (skip_word("sqrt")) {
            if (!skip('(')) fail("sqrt needs parentheses");
            const double value = sum();
            if (!skip(')')) fail("a closing parenthesis is missing");
            if (value < 0) fail("sqrt of a negative number");
            return std::sqrt(value);
        }
        double value = 0;
        const auto [end, failed] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
        const auto length = static_cast<std::size_t>(end - rest_.data());
        // from_chars also knows "inf" and "nan".
        if (failed != std::errc() || length == 0 || !(rest_[0] == '.' || (rest_[0] >= '0' && rest_[0] <= '9'))) {
            fail(rest_.empty() ? "a number is missing" : "a number is missing at \"" + std::string(rest_) + "\"");
            return 0;
        }
        rest_.remove_prefix(length);
        return with_unit(value);
    }
    // A unit reaches as far as it can be read: of "2 m/s" all, of "2 m/4" only "m".
    double with_unit(double value) {
        skip_spaces();
        std::size_t most = 0;
        while (most < rest_.size() && std::string_view("+-()").find(rest_[most]) == std::string_view::npos) ++most;
        std::string_view other;
        for (std::size_t length = most; length > 0; --length) {
            const std::string_view candidate = trimmed(rest_.substr(0, length));
            if (candidate.empty()) continue;
            if (const auto factor = conversion(candidate, unit_)) {
                rest_.remove_prefix(length);
                return value * *factor;
            }
            if (other.empty() && parse_unit(candidate)) other = candidate;
        }
        if (!other.empty()) {
            fail(unit_.empty() ? std::string(other) + ": this is a pure number"
                               : std::string(other) + " cannot be converted to " + std::string(unit_));
        }
        return value;
    }
    static std::string_view trimmed(std::string_view text) {
        while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
        return text;
    }
    void skip_spaces() {
        while (!rest_.empty() && rest_.front() == ' ') rest_.remove_prefix(1);
    }
    bool skip(char c) {
        skip_spaces();
        if (rest_.empty() || rest_.front() != c) return false;
        rest_.remove_prefix(1);
        return true;
    }
    bool skip_word(std::string_view word) {
        if (!rest_.starts_with(word)) return false;
        rest_.remove_prefix(word.size());
        return true;
    }

    std::string_view rest_, unit_;
    std::optional<std::string> error_;
    int depth_ = 0;
};

}  // namespace

Result<double> evaluate(std::string_view typed, std::string_view unit, double now) {
    const std::string text = plain(typed);
    std::string_view rest = text;
    while (!rest.empty() && rest.front() == ' ') rest.remove_prefix(1);
    char change = 0;
    if (rest.starts_with("+=") || rest.starts_with("-=")) {
        change = rest[0];
        rest.remove_prefix(2);
    } else if (rest.starts_with('*') || rest.starts_with('/')) {
        change = rest[0];
        rest.remove_prefix(1);
        if (rest.starts_with('=')) rest.remove_prefix(1);
    }
    Evaluation evaluation(rest, unit);
    double value = evaluation.sum();
    if (!evaluation.error() && !evaluation.at_end())
        evaluation.fail("\"" + std::string(evaluation.rest()) + "\" is not understood");
    if (change == '/' && value == 0) evaluation.fail("division by zero");
    if (evaluation.error()) return Error{"", *evaluation.error()};
    if (change == '+') value = now + value;
    if (change == '-') value = now - value;
    if (change == '*') value = now * value;
    if (change == '/') value = now / value;
    if (!std::isfinite(value)) return Error{"", "the result is not a finite number"};
    return value;
}

std::string format_number(double value, int digits) {
    if (value == 0) return "0";  // also -0
    char text[40];
    std::snprintf(text, sizeof text, "%.*g", digits, value);
    std::string out = text;
    const std::size_t exponent = out.find('e');
    if (exponent == std::string::npos) return out;
    int power = 0;
    const std::size_t first = out[exponent + 1] == '+' ? exponent + 2 : exponent + 1;
    std::from_chars(out.data() + first, out.data() + out.size(), power);
    if (power >= digits && power < 7) {  // 12000 rather than 1.2e4
        std::snprintf(text, sizeof text, "%.0f", value);
        return text;
    }
    return out.substr(0, exponent) + "e" + std::to_string(power);
}

std::string format_short(double value, int digits) {
    std::string plain = format_number(value, digits);
    if (value == 0 || !std::isfinite(value)) return plain;
    char text[40];
    std::snprintf(text, sizeof text, "%.*e", digits - 1, value);
    std::string out = text;
    const std::size_t exponent = out.find('e');
    int power = 0;
    const std::size_t first = out[exponent + 1] == '+' ? exponent + 2 : exponent + 1;
    std::from_chars(out.data() + first, out.data() + out.size(), power);
    std::string mantissa = out.substr(0, exponent);
    if (mantissa.find('.') != std::string::npos) {
        mantissa.erase(mantissa.find_last_not_of('0') + 1);
        if (mantissa.back() == '.') mantissa.pop_back();
    }
    out = mantissa + "e" + std::to_string(power);
    return out.size() < plain.size() ? out : plain;
}

std::string format_number(double value, std::string_view unit, int digits) {
    std::string text = format_number(value, digits);
    if (unit.empty()) return text;
    return text + (unit == "°" || unit == "%" ? "" : " ") + std::string(unit);
}

}  // namespace weft::editor
