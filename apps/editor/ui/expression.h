// What people type into a number field: "0.2", "5 mm", "3/4", "2*(1 + 0.5)", "=*1.1".
#pragma once

#include <weft/result.h>

#include <string>
#include <string_view>

namespace weft::editor {

/// Computes a number in `unit`. Knows + - * / ^, parentheses, pi, sqrt(); also × · − and a comma as decimal sign where
/// no dot is. A number may have a unit after it and then counts in that unit; others count in `unit`. A text that
/// begins with *, / or += changes `now`, the present value. The error is for the person who types.
Result<double> evaluate(std::string_view text, std::string_view unit, double now = 0);

/// A number as short as it can be with that many significant digits: "0.25", "1200", "1e-6".
std::string format_number(double value, int digits = 4);
/// The same with its unit: "0.25 N/m", "30°".
std::string format_number(double value, std::string_view unit, int digits = 4);
/// With at most so many digits and an exponent where that is shorter: 1.5e-4 in place of 0.00015.
std::string format_short(double value, int digits);

}  // namespace weft::editor
