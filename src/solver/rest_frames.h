// How the cloth lies at rest, place by place: what tells whether a straight line between two places stays on it.
#pragma once

#include "physics/rest_shape.h"

#include <vector>

namespace weft {

struct RestFrame {
    Vec3 normal, warp;  ///< unit; 0 where there are no triangles
};

/// Per particle: means over its triangles.
std::vector<RestFrame> rest_frames(const RestShape& rest);

/// Of the straight line between two places, m.
struct StraightLine {
    double length = 0;
    double reach = 0;  ///< as far as they can come apart where the fabric shears: along warp plus along weft
};

/// Zero where the cloth is not flat between them, as far as their frames tell, or its warp turns.
StraightLine straight_line(const RestFrame& a, const RestFrame& b, Vec3 from_a_to_b);

}  // namespace weft
