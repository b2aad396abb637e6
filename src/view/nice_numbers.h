// Round numbers for scales.
#pragma once

#include <string>
#include <vector>

namespace weft {

/// The smallest of 1, 2, 5, 10, 20, 50, … and 0.5, 0.2, 0.1, … that is not below `value`; 1 where that is not above 0
/// or not finite.
double nice_above(double value);

/// The value that a share of all finite ones do not exceed; 0 where there is none.
double percentile(std::vector<float> values, double share);

/// Three digits, no more zeros than are needed: "0.25", "1.5", "12000".
std::string short_number(double value);

}  // namespace weft
