// What tests compare of feedback.
#pragma once

#include "solver/state/feedback.h"

#include <weft/feedback.h>

#include <bit>
#include <cstdint>
#include <vector>

namespace weft {

/// Every bit of it.
inline std::vector<std::uint32_t> bits_of(const Feedback& feedback) {
    std::vector<std::uint32_t> bits{static_cast<std::uint32_t>(feedback.frame)};
    const auto add = [&](Vec3 v) {
        for (const float f : {v.x, v.y, v.z}) bits.push_back(std::bit_cast<std::uint32_t>(f));
    };
    for (const ColliderLoad& load : feedback.colliders) {
        bits.insert(bits.end(), {load.collider.index, load.collider.generation, load.contacts});
        add(load.impulse), add(load.angular_impulse), add(load.force), add(load.torque);
    }
    for (const Contact& contact : feedback.contacts) {
        bits.insert(bits.end(), {contact.cloth.index, contact.collider.index, contact.vertex});
        add(contact.point), add(contact.impulse);
    }
    return bits;
}

}  // namespace weft
