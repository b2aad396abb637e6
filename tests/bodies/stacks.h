// Towers of boxes.
#pragma once

#include "body_worlds.h"

#include <vector>

namespace weft::physical {

/// A floor and boxes with sides of 10 cm, one on the other. Each is shifted by multiples of `shift`, m, and turned by
/// multiples of `degrees`, less than 30.
inline std::vector<ColliderId> add_tower(World& world, int count, float shift = 0, int degrees = 0) {
    world.add(make_floor());
    std::vector<ColliderId> boxes;
    for (int i = 0; i < count; ++i) {
        Collider box = make_box({0.05f, 0.05f, 0.05f}, 0.5f,
                                {shift * static_cast<float>(i * 7 % 5 - 2), 0.05f + 0.1f * static_cast<float>(i),
                                 shift * static_cast<float>(i * 3 % 5 - 2)});
        box.pose.rotation = rotation_from_degrees({0, static_cast<float>(i * degrees % 30), 0});
        boxes.push_back(world.add(box));
    }
    return boxes;
}

/// A rod of 44 cm along x, in the middle of which is `position`.
inline Collider make_rod(Vec3 position) {
    Collider rod = make_collider({.name = "rod", .shape = CapsuleDesc{.radius = 0.02f, .half_height = 0.2f}});
    rod.pose = {rotation_from_degrees({0, 0, 90}), position};
    rod.body = make_box({0.02f, 0.2f, 0.02f}, 0.3f, {}).body;
    return rod;
}

}  // namespace weft::physical
