// How the cloth lies at rest, place by place: what tells whether a straight line between two places stays on it.
#pragma once

#include "physics/rest_shape.h"

#include <vector>

namespace weft {

/// What RestShape::frames holds, of its areas and warps.
std::vector<RestFrame> rest_frames(const RestShape& rest);

/// Of the straight line between two places, m.
struct StraightLine {
    double length = 0;
    double along_warp = 0, along_weft = 0;  ///< how far it goes in these directions, ≥ 0
};

/// Whether a way over the cloth runs as the straight line does, but for the corners that edges give it. One that is
/// longer leads around something.
inline bool follows(double way, const StraightLine& line) {
    return way <= 1.12 * line.length;
}

/// Zero where the cloth is not flat between them, as far as their frames tell, or its warp turns.
StraightLine straight_line(const RestFrame& a, const RestFrame& b, Vec3 from_a_to_b);

}  // namespace weft
