// Contacts between cloths and colliders, and the forces of the cloths on the colliders.
#pragma once

#include <weft/ids.h>
#include <weft/vector.h>

#include <cstdint>
#include <vector>

namespace weft {

/// A particle that touched a collider during the frame.
struct Contact {
    ClothId cloth;
    ColliderId collider;
    /// The first vertex of the mesh that belongs to this particle; no_vertex if the cloth has a separate render mesh.
    std::uint32_t vertex = 0;
    Vec3 point;    ///< m, position of the particle at the end of the frame
    Vec3 impulse;  ///< N·s, on the collider, summed over the frame: pressure and friction

    static constexpr std::uint32_t no_vertex = ~std::uint32_t{0};
};

/// Sum of the contact forces of all cloths on one collider in a frame.
struct ColliderForce {
    ColliderId collider;
    Vec3 impulse;                ///< N·s
    Vec3 angular_impulse;        ///< N·m·s, about the collider's position
    Vec3 force;                  ///< N, mean over the frame: impulse / length of the frame
    Vec3 torque;                 ///< N·m, mean over the frame
    std::uint32_t contacts = 0;  ///< number of contacts; complete even if the list was full ("ContactsFull")
};

/// All contacts of one frame, and their sums.
struct ContactForces {
    std::uint64_t frame = 0;               ///< number of the frame that the values are of; 0: none yet
    std::vector<ColliderForce> colliders;  ///< all colliders of that frame, in the order in which they were added
    std::vector<Contact> contacts;         ///< sorted by cloth, then by collider
};

}  // namespace weft
