// Says which cloths collide with each other.
#pragma once

#include <cstdint>

namespace weft {

struct CollisionFilter {
    std::uint32_t groups = 1;  ///< bits: groups that it belongs to
    std::uint32_t mask = ~0u;  ///< bits: groups that it collides with
    friend bool operator==(const CollisionFilter&, const CollisionFilter&) = default;
};

/// Symmetric: each one's mask has to contain a group of the other one.
inline bool collide(const CollisionFilter& a, const CollisionFilter& b) {
    return (a.groups & b.mask) != 0 && (b.groups & a.mask) != 0;
}

}  // namespace weft
