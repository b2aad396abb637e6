// Round numbers for scales.
#pragma once

#include <string>
#include <vector>

namespace weft {

/// The smallest of …, 0.1, 0.2, 0.5, 1, 2, 5, 10, … that is not below `value`; 1 if `value` is not positive and finite.
double nice_above(double value);

/// The value that a share of all finite values do not exceed; 0 if there is none.
double percentile(std::vector<float> values, double share);

/// Three significant digits without trailing zeros: "0.25", "1.5", "12000".
std::string short_number(double value);

}  // namespace weft
