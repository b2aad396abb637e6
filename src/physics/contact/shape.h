// What a shape's *.data.h is written with.
#pragma once

#include "base/parameter.h"

#include <weft/scene.h>

#include <array>
#include <cstddef>
#include <string_view>

namespace weft {

/// What is wrong with a value though it lies within its range; nothing if `what` is empty.
struct ShapeProblem {
    std::string_view key = {}, what = {};
};

/// For shapes whose ranges say all there is to say; another has an overload in its *.data.h.
template <class Desc>
constexpr ShapeProblem shape_problem(const Desc&) {
    return {};
}

}  // namespace weft
