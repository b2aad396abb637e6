// Crossings of cloth with the triangles of colliders.
#pragma once

#include "collide/crossings.h"
#include "solver/world/world.h"

#include <cstdint>
#include <vector>

namespace weft {

/// Edges of a cloth that pass through a triangle of a collider's surface, or the other way around, in the last frame.
inline std::size_t crossings_with_colliders(const World& world) {
    std::vector<Vec3> positions;
    std::vector<Triangle> triangles;
    for (const ClothFrame& cloth : world.frame().cloths) {
        const auto base = static_cast<std::uint32_t>(positions.size());
        for (const Vec4& x : cloth.positions) positions.push_back(x.xyz());
        for (const Triangle t : cloth.triangles) triangles.push_back({base + t[0], base + t[1], base + t[2]});
    }
    const auto first = static_cast<std::uint32_t>(positions.size());
    for (const Collider& collider : world.colliders()) {
        if (!collider.surface) continue;
        const auto base = static_cast<std::uint32_t>(positions.size());
        for (std::uint32_t p = 0; p < collider.surface->particle_count; ++p)
            positions.push_back(to_world(collider.pose, collider.surface->rest_position(p)));
        for (const Triangle t : collider.surface->triangles())
            triangles.push_back({base + t[0], base + t[1], base + t[2]});
    }
    return find_crossings(positions, triangles,
                          [&](std::uint32_t p, std::uint32_t q) { return (p < first) != (q < first); })
        .size();
}

}  // namespace weft
