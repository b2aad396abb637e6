#include "editor/ui/units.h"

#include <cmath>
#include <numbers>
#include <string>

namespace weft::editor {
namespace {

struct NamedUnit {
    std::string_view name;
    double factor;
    std::array<int, 4> powers;
    bool prefixes;  // takes m, k, …
};

constexpr double degree = std::numbers::pi / 180;

constexpr NamedUnit named_units[] = {
    {"m", 1, {1, 0, 0, 0}, true},       {"g", 1e-3, {0, 1, 0, 0}, true},      {"s", 1, {0, 0, 1, 0}, true},
    {"N", 1, {1, 1, -2, 0}, true},      {"Pa", 1, {-1, 1, -2, 0}, true},      {"J", 1, {2, 1, -2, 0}, true},
    {"W", 1, {2, 1, -3, 0}, true},      {"Hz", 1, {0, 0, -1, 0}, true},       {"rad", 1, {0, 0, 0, 1}, true},
    {"°", degree, {0, 0, 0, 1}, false}, {"deg", degree, {0, 0, 0, 1}, false}, {"min", 60, {0, 0, 1, 0}, false},
    {"h", 3600, {0, 0, 1, 0}, false},   {"in", 0.0254, {1, 0, 0, 0}, false},  {"%", 0.01, {}, false},
    {"frames", 1, {}, false},           {"t", 1000, {0, 1, 0, 0}, false},
};

struct Prefix {
    std::string_view name;
    double factor;
};
constexpr Prefix prefixes[] = {{"", 1},     {"n", 1e-9}, {"u", 1e-6}, {"µ", 1e-6}, {"μ", 1e-6},
                               {"m", 1e-3}, {"c", 1e-2}, {"d", 1e-1}, {"k", 1e3},  {"M", 1e6}};

std::optional<Unit> unit_by_name(std::string_view name) {
    for (const Prefix& prefix : prefixes) {
        if (!name.starts_with(prefix.name)) continue;
        for (const NamedUnit& unit : named_units) {
            if (unit.name == name.substr(prefix.name.size()) && (unit.prefixes || prefix.name.empty()))
                return Unit{prefix.factor * unit.factor, unit.powers};
        }
    }
    return std::nullopt;
}

/// Removes the text from the front.
bool skip(std::string_view& rest, std::string_view text) {
    if (!rest.starts_with(text)) return false;
    rest.remove_prefix(text.size());
    return true;
}

// "²", "⁻¹", "^2", "^-1", "2"; 1 if there is none.
int take_power(std::string_view& rest) {
    constexpr std::string_view raised[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶"};
    const bool caret = skip(rest, "^");
    const bool minus = skip(rest, "⁻") || (caret && skip(rest, "-"));
    for (int i = 0; i < 7; ++i) {
        const char digit = static_cast<char>('0' + i);
        if (skip(rest, raised[i]) || skip(rest, {&digit, 1})) return minus ? -i : i;
    }
    return 1;
}

bool ends_name(std::string_view rest) {
    for (const std::string_view end : {"·", "*", "/", "^", "⁻", "¹", "²", "³", "⁴", "⁵", "⁶", " "})
        if (rest.starts_with(end)) return true;
    return rest[0] >= '0' && rest[0] <= '9';
}

}  // namespace

std::optional<Unit> parse_unit(std::string_view rest) {
    Unit whole;
    int sign = 1;
    while (true) {
        while (skip(rest, " ")) {
        }
        if (sign == 1 && rest.starts_with("1/")) {
            rest.remove_prefix(1);
        } else {
            std::size_t length = 0;
            while (length < rest.size() && !ends_name(rest.substr(length))) ++length;
            const auto unit = unit_by_name(rest.substr(0, length));
            if (!unit) return std::nullopt;
            rest.remove_prefix(length);
            const int power = sign * take_power(rest);
            whole.factor *= std::pow(unit->factor, power);
            for (std::size_t i = 0; i < 4; ++i) whole.powers[i] += power * unit->powers[i];
        }
        while (skip(rest, " ")) {
        }
        if (rest.empty()) return whole;
        if (skip(rest, "/")) {
            sign = -1;  // "J/kg·m" divides by both
        } else if (!skip(rest, "·") && !skip(rest, "*")) {
            return std::nullopt;
        }
    }
}

std::optional<double> conversion(std::string_view from, std::string_view to) {
    if (from == to) return 1;
    const auto one = parse_unit(from), other = to.empty() ? std::optional(Unit{}) : parse_unit(to);
    if (!one || !other || one->powers != other->powers) return std::nullopt;
    return one->factor / other->factor;
}

}  // namespace weft::editor
