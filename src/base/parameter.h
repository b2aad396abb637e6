// A value of a scene or a material as data: the scene reader, the checks, the documentation and the editor's sliders
// all read these tables.
#pragma once

#include <cstddef>
#include <limits>
#include <string_view>

namespace weft {

/// Farther from the origin a float no longer resolves a fiber: 10⁶ m is told in steps of 6 cm.
inline constexpr double far_away = 1e6;

enum class ParameterKind {
    number,         ///< `count` floats; one number may stand for all of them
    flag,           ///< bool
    angle_or_mesh,  ///< one float in degrees, or "mesh", which is stored as NaN
    vector,         ///< `count` floats, every one of them written
    integer,        ///< `count` std::uint32_t, every one of them written
    choice,         ///< an enum of int's size, its enumerators 0, 1, … named by `choices` in that order
    text,           ///< std::string
    object,         ///< keys of its own: no value, the key alone is listed here
    list,           ///< likewise
};

struct Parameter {
    std::string_view key = {};  ///< as in a scene file
    ParameterKind kind = ParameterKind::number;
    unsigned count = 1;
    std::size_t offset = 0;  ///< of the first element in the struct that the table describes
    double min = 0, max = std::numeric_limits<float>::max();
    bool min_excluded = false;      ///< the value must be greater than `min`
    std::string_view unit = {};     ///< SI; empty for a pure number
    std::string_view what = {};     ///< one line for a human
    std::string_view choices = {};  ///< `choice` only: the names, separated by '|'
    bool required = false;
};

}  // namespace weft
