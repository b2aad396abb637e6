// Stores values that a program gives by key in the members of a struct that a parameter table describes.
#pragma once

#include "base/parameter.h"
#include "scene/problems.h"

#include <weft/scene.h>

#include <span>
#include <string>

namespace weft {

/// Stores `value` in the struct at `base`. If the value has the wrong type, returns what the parameter expects: `must
/// be true or false`. check_values() checks the ranges.
std::string set_value(const Parameter& parameter, void* base, const ParameterValue& value);

/// Stores all values. Unknown keys and values of the wrong type are reported as problems below `pointer`.
void set_values(std::span<const Parameter> table, void* base, const ParameterValues& values, const std::string& pointer,
                Problems& problems);

}  // namespace weft
