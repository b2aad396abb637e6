// Normal and warp direction of the cloth at rest, per particle. They show whether a straight line between two particles
// stays on the cloth.
#pragma once

#include "physics/rest_shape.h"

#include <vector>

namespace weft {

/// Computes RestShape::frames from its areas and warps.
std::vector<RestFrame> rest_frames(const RestShape& rest);

/// The straight line between two points, m.
struct StraightLine {
    double length = 0;
    double along_warp = 0, along_weft = 0;  ///< its extent in these directions, ≥ 0
};

/// Whether a geodesic of length `way` follows the straight line. It may be 12 % longer because mesh edges bend it; a
/// longer one makes a detour.
inline bool follows(double way, const StraightLine& line) {
    return way <= 1.12 * line.length;
}

/// Zero if, judged by the two frames, the cloth between the points is not flat or its warp direction turns.
StraightLine straight_line(const RestFrame& a, const RestFrame& b, Vec3 from_a_to_b);

}  // namespace weft
