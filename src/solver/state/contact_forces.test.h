// Comparison of ContactForces in tests.
#pragma once

#include "solver/state/contact_forces.h"

#include <weft/contact_forces.h>

#include <bit>
#include <cstdint>
#include <vector>

namespace weft {

/// All values as bits.
inline std::vector<std::uint32_t> bits_of(const ContactForces& contact_forces) {
    std::vector<std::uint32_t> bits{static_cast<std::uint32_t>(contact_forces.frame)};
    const auto add = [&](Vec3 v) {
        for (const float f : {v.x, v.y, v.z}) bits.push_back(std::bit_cast<std::uint32_t>(f));
    };
    for (const ColliderForce& load : contact_forces.colliders) {
        bits.insert(bits.end(), {load.collider.index, load.collider.generation, load.contacts});
        add(load.impulse), add(load.angular_impulse), add(load.force), add(load.torque);
    }
    for (const Contact& contact : contact_forces.contacts) {
        bits.insert(bits.end(), {contact.cloth.index, contact.collider.index, contact.vertex});
        add(contact.point), add(contact.impulse);
    }
    return bits;
}

}  // namespace weft
