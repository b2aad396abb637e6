// From values that a program gives by keys to the members of a struct that a parameter table describes.
#pragma once

#include "base/parameter.h"
#include "scene/problems.h"

#include <weft/scene.h>

#include <span>
#include <string>

namespace weft {

/// Stores `value` in the struct at `base`. If the value is of the wrong kind, returns what the parameter expects:
/// `must be true or false`. Ranges are checked by check_values().
std::string set_value(const Parameter& parameter, void* base, const ParameterValue& value);

/// Stores all values. A key that is not in `table` and a value of the wrong kind are problems below `pointer`.
void set_values(std::span<const Parameter> table, void* base, const ParameterValues& values, const std::string& pointer,
                Problems& problems);

}  // namespace weft
