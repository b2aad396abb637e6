// A grab as a frame gets it, and what comes back.
#pragma once

#include <weft/grab.h>
#include <weft/vector.h>

#include <cstdint>

namespace weft {

/// A point in a triangle of a cloth and where it is pulled to during a frame.
struct GrabStep {
    std::uint32_t triangle = 0;
    Vec3 weights;   ///< of its corners; their sum is 1
    Vec3 from, to;  ///< m: the target moves from one to the other
    GrabDesc spring = {};
};

/// m: how far the largest force of a grab moves the hand in a substep, from rest, in mean edges. With more, the point
/// stands out of the cloth by as much; with less, the hand is slow.
inline constexpr float hand_reach_in_edges = 0.5f;

}  // namespace weft
