// Describes a value of a scene or a material as data. The scene reader, the checks, the documentation and the editor's
// sliders read these tables.
#pragma once

#include <cstddef>
#include <limits>
#include <string_view>

namespace weft {

/// Limit for scene values: at 10⁶ m from the origin floats are 6 cm apart, too coarse for cloth.
inline constexpr double far_away = 1e6;

/// The `above_hint` of colors.
inline constexpr std::string_view color_hint =
    "; colors are linear RGB from 0 to 1: for values from 0 to 255, use (value / 255)^2.2";

enum class ParameterKind {
    number,         ///< `count` floats; one number sets all of them
    flag,           ///< bool
    angle_or_mesh,  ///< one float in degrees, or "mesh", which is stored as NaN
    vector,         ///< `count` floats, all of them given
    integer,        ///< `count` std::uint32_t, all of them given
    choice,         ///< an enum of int's size; `choices` names its enumerators 0, 1, … in that order
    text,           ///< std::string
    object,         ///< a nested object: no value, only its key is listed here
    list,           ///< a list of objects: no value, only its key is listed here
};

struct Parameter {
    std::string_view key = {};  ///< as in a scene file
    ParameterKind kind = ParameterKind::number;
    unsigned count = 1;
    std::size_t offset = 0;  ///< of the first element in the struct that the table describes
    double min = 0, max = std::numeric_limits<float>::max();
    bool min_excluded = false;           ///< the value must be greater than `min`
    bool zero_too = false;               ///< 0 is valid although it is below `min`
    std::string_view unit = {};          ///< SI; empty for a pure number
    std::string_view above_hint = {};    ///< end of the message about a value above `max`
    std::string_view what = {};          ///< one line of documentation
    std::string_view choices = {};       ///< `choice` only: the names, separated by '|'
    std::string_view choice_words = {};  ///< a short line about each of them, separated by '|'; may be empty
    bool required = false;
    bool flag_too = false;  ///< `choice` only: `false` stands for the first name and `true` for the last
};

}  // namespace weft
