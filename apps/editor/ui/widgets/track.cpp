// Ranges of numbers, and positions along sliders.
#include "editor/ui/expression.h"
#include "editor/ui/widgets/number.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace weft::editor {
namespace {

constexpr double decades = 1000;  // a range this wide is logarithmic

/// Limits of the tables that no scene comes near stand for none.
bool is_limit(double value) {
    return std::isfinite(value) && std::abs(value) < far_away;
}

}  // namespace

NumberRange range_of(const Parameter& parameter) {
    NumberRange range;
    range.min = parameter.min;
    range.max = parameter.max >= static_cast<double>(std::numeric_limits<float>::max())
                    ? std::numeric_limits<double>::infinity()
                    : parameter.max;
    range.min_excluded = parameter.min_excluded;
    range.zero_too = parameter.zero_too;
    range.unit = parameter.unit;
    range.integer = parameter.kind == ParameterKind::integer;
    return range;
}

std::string describe(const NumberRange& range) {
    const bool lower = is_limit(range.min), upper = is_limit(range.max);
    const std::string unit = range.unit.empty() ? "" : " " + std::string(range.unit);
    const std::string zero = range.zero_too && range.min > 0 ? ", or 0" : "";
    if (lower && upper) {
        return (range.min_excluded ? "over " : "") + format_number(range.min) + " … " + format_number(range.max) +
               unit + zero;
    }
    if (lower) return (range.min_excluded ? "> " : "≥ ") + format_number(range.min) + unit + zero;
    if (upper) return "≤ " + format_number(range.max) + unit;
    return range.unit.empty() ? "" : "in " + std::string(range.unit);
}

double clamped(double value, const NumberRange& range) {
    if (range.integer) value = std::round(value);
    if (range.zero_too && range.min > 0 && value < range.min / 2) return 0;
    if (range.min_excluded && value <= range.min) {
        // The least value that a drag shows.
        const double step = range.integer ? 1 : is_limit(range.max) ? (range.max - range.min) / 1e4 : 1e-6;
        value = range.min + std::min(step, 1e-6 + std::abs(range.min));
        if (range.integer) value = range.min + 1;
    }
    return std::clamp(value, range.min, range.max);
}

Track::Track(const NumberRange& range, double value) : integer_(range.integer) {
    const double usual = range.usual.value_or(0), near = std::max(std::abs(usual), std::abs(value));
    const bool lower = is_limit(range.min), upper = is_limit(range.max);
    if (lower && (upper || range.min >= 0)) {
        min_ = range.min;
        max_ = upper ? range.max : std::max(std::max(1000 * std::abs(usual), 10 * std::abs(value)), min_ + 1);
        if (std::abs(max_) > far_away && !upper) max_ = std::max(std::abs(value), far_away);
        // Where the interesting values are: around the default.
        const double least = min_ > 0 ? min_ : usual > min_ ? (usual - min_) / 100 : (max_ - min_) / 1e4;
        const bool wide = min_ > 0
                              ? max_ / min_ >= decades
                              : (!upper || (usual > min_ && max_ - min_ > 30 * (usual - min_)) || max_ - min_ > 2e3);
        if (wide && !(integer_ && max_ - min_ < decades)) knee_ = least;
        return;
    }
    bounded_ = false;  // a drag over the field moves about by the value itself
    const double span = std::max(near, 0.5);
    min_ = value - span;
    max_ = value + span;
}

double Track::position(double value) const {
    if (max_ <= min_) return 0;
    if (knee_ <= 0) return (value - min_) / (max_ - min_);
    return std::log1p(std::max(0.0, value - min_) / knee_) / std::log1p((max_ - min_) / knee_);
}

double Track::value(double position) const {
    if (bounded_) position = std::clamp(position, 0.0, 1.0);
    if (knee_ <= 0) return min_ + position * (max_ - min_);
    return min_ + knee_ * std::expm1(position * std::log1p((max_ - min_) / knee_));
}

double Track::rounded(double value, double pixels) const {
    if (integer_) return std::round(value);
    if (value == 0) return 0;
    double resolved = (max_ - min_) / std::max(10.0, pixels);
    if (knee_ > 0) resolved = (std::abs(value) + knee_) / 200;
    const double step = std::pow(10, std::floor(std::log10(resolved)));
    // Through text, so that the result is the nearest number to the decimals shown.
    return std::strtod(format_number(std::round(value / step) * step, 9).c_str(), nullptr);
}

}  // namespace weft::editor
