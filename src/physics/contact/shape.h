// Common declarations for the *.data.h files of the shapes.
#pragma once

#include "base/parameter.h"

#include <weft/bounds.h>
#include <weft/scene.h>

#include <array>
#include <cstddef>
#include <limits>
#include <string_view>

namespace weft {

/// A problem with a value that lies within its range; none if `what` is empty.
struct ShapeProblem {
    std::string_view key = {}, what = {};
};

/// The box of a shape that has no end.
inline constexpr Bounds everywhere{{-std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity(),
                                    -std::numeric_limits<float>::infinity()},
                                   {std::numeric_limits<float>::infinity(), std::numeric_limits<float>::infinity(),
                                    std::numeric_limits<float>::infinity()}};

/// Default for shapes with edges or corners. m: the least radius to which the surface is curved outward.
template <class Desc>
constexpr float shape_roundness(const Desc&) {
    return 0;
}

/// Default, for shapes without data. m: how far through the shape what passes it has to move at least. What a shape
/// with data adds to ShapeData::width.
template <class Desc>
constexpr float shape_width(const Desc& shape) {
    return 2 * shape_roundness(shape);
}

/// Default for shapes that need no checks besides the ranges. Other shapes overload it in their *.data.h.
template <class Desc>
constexpr ShapeProblem shape_problem(const Desc&) {
    return {};
}

}  // namespace weft
