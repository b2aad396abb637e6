// What cloth does to the colliders that it touches: who touches whom, and how hard.
#pragma once

#include <weft/ids.h>
#include <weft/vector.h>

#include <cstdint>
#include <vector>

namespace weft {

/// A place of a cloth that pressed or rubbed on a collider during the frame.
struct Contact {
    ClothId cloth;
    ColliderId collider;
    /// The first vertex of the drawn mesh that is this place of the cloth; no_vertex where another mesh is drawn than
    /// is simulated.
    std::uint32_t vertex = 0;
    Vec3 point;  ///< m, where it is when the frame ends
    Vec3
        impulse;  ///< N·s, what the collider got there in the frame: along the surface by friction, into it by pressure

    static constexpr std::uint32_t no_vertex = ~std::uint32_t{0};
};

/// What all cloths together did to a collider in the frame.
struct ColliderLoad {
    ColliderId collider;
    Vec3 impulse;                ///< N·s
    Vec3 angular_impulse;        ///< N·m·s, about the collider's position
    Vec3 force;                  ///< N, the mean over the frame: impulse over its length
    Vec3 torque;                 ///< N·m, likewise
    std::uint32_t contacts = 0;  ///< how many; all of them, even where the list had no room ("ContactsFull")
};

struct Feedback {
    std::uint64_t frame = 0;              ///< the one that it is of; 0: there is none yet
    std::vector<ColliderLoad> colliders;  ///< all there were in that frame, in the order in which they were added
    std::vector<Contact> contacts;        ///< cloth by cloth, of each collider by collider
};

}  // namespace weft
