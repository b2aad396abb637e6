// Units of numbers that people type: "5 mm" for a length in meters.
#pragma once

#include <array>
#include <optional>
#include <string_view>

namespace weft::editor {

/// A unit as a factor and powers of meter, kilogram, second and radian.
struct Unit {
    double factor = 1;
    std::array<int, 4> powers{};
};

/// "kg/m²", "N·m", "mm", "m^2", "1/s", "°", "%". Nothing if it is not known.
std::optional<Unit> parse_unit(std::string_view text);

/// The factor from numbers in the unit `from` to numbers in the unit `to`. Nothing if they measure different things, or
/// one of them is not known. A text that is not a unit fits only itself.
std::optional<double> conversion(std::string_view from, std::string_view to);

}  // namespace weft::editor
