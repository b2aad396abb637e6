// Grabs: pulling a cloth at a point while it runs.
#pragma once

namespace weft {

inline constexpr float largest_grab_force = 1e6f;  ///< N

/// How a grab pulls: a damped spring between a point of a cloth and a target, with a limited force.
struct GrabDesc {
    /// N, > 0, ≤ largest_grab_force: the pull is never stronger.
    float max_force = 20;
    /// m/N, 0…1e6: distance between point and target per newton; 0: rigid up to `max_force`.
    float compliance = 0;
    /// s, 0…10: how long the point takes to approach a target that it does not follow rigidly. 0: undamped. Too little
    /// lets the point swing about its target.
    float damping = 0.02f;
    friend bool operator==(const GrabDesc&, const GrabDesc&) = default;
};

}  // namespace weft
