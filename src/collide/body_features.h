// The parts of a body's surface that can touch other bodies first: rounded points and rounded edges.
#pragma once

#include <weft/vector.h>

#include <vector>

namespace weft {

/// A ball that belongs to a body.
struct RoundPoint {
    Vec3 place;        ///< m, in the body's frame
    float radius = 0;  ///< m
};

/// All balls between two balls of a body.
struct RoundEdge {
    Vec3 from, to;                         ///< m, in the body's frame
    float radius_from = 0, radius_to = 0;  ///< m; between them linear
};

struct BodyFeatures {
    std::vector<RoundPoint> points;
    std::vector<RoundEdge> edges;
};

}  // namespace weft
