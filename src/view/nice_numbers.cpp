#include "view/nice_numbers.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace weft {

double nice_above(double value) {
    if (!(value > 0) || !std::isfinite(value)) return 1;
    const double decade = std::floor(std::log10(value));
    // The tolerance accepts values that exceed a nice number only by rounding.
    for (const double power : {decade - 1, decade, decade + 1}) {
        for (const double digit : {1.0, 2.0, 5.0}) {
            const double nice = power < 0 ? digit / std::pow(10, -power) : digit * std::pow(10, power);
            if (nice >= value * (1 - 1e-6)) return nice;
        }
    }
    return value;
}

double percentile(std::vector<float> values, double share) {
    std::erase_if(values, [](float value) { return !std::isfinite(value); });
    if (values.empty()) return 0;
    const auto last = static_cast<double>(values.size() - 1);
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(std::ceil(share * last));
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

std::string short_number(double value) {
    char text[32];
    const double size = std::abs(value);
    if (size >= 999.5 && size < 1e6) {
        std::snprintf(text, sizeof text, "%.0f", value);
    } else {
        std::snprintf(text, sizeof text, "%.3g", value == 0 ? 0.0 : value);
    }
    return text;
}

}  // namespace weft
