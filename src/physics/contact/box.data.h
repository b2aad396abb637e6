// Box around the collider's origin. Scene keys; the math is in box.kernel.h.
#pragma once

#include "physics/contact/shape.h"

#include <algorithm>

namespace weft {

inline constexpr std::string_view box_what = "a box around the collider's origin";

inline constexpr Parameter box_parameters[] = {
    {.key = "half_extents", .kind = ParameterKind::vector, .count = 3, .offset = offsetof(BoxDesc, half_extents),
     .min = 0, .max = far_away, .min_excluded = true, .unit = "m", .what = "half of its size along x, y and z"},
};

inline std::array<float, 4> shape_numbers(const BoxDesc& box) {
    return {box.half_extents.x, box.half_extents.y, box.half_extents.z, 0};
}

constexpr float shape_width(const BoxDesc& box) {
    return 2 * std::min({box.half_extents.x, box.half_extents.y, box.half_extents.z});
}

inline Bounds shape_bounds(const BoxDesc& box) {
    return {-box.half_extents, box.half_extents};
}

}  // namespace weft
