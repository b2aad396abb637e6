// Shapes for tests of passes.
#pragma once

#include "collide/convex_hull.h"
#include "collide/distance_field.h"
#include "mesh/procedural.h"
#include "solver/world/collider.h"

#include <vector>

namespace weft::cpu {

/// Data for shapes that read some, with a surface about 0.5 from the origin.
inline ShapeBlocks sample_blocks(std::uint32_t shape) {
    static const ShapeData convex = [] {
        std::vector<Vec3> corners;
        for (int i = 0; i < 8; ++i)
            corners.push_back({i & 1 ? 0.5f : -0.4f, i & 2 ? 0.4f : -0.5f, i & 4 ? 0.6f : -0.3f});
        return make_convex_data(*convex_hull(corners));
    }();
    static const ShapeData mesh = [] {
        const TriangleMesh sphere = make_sphere(0.6f, 3);
        return build_distance_field(sphere.positions, sphere.triangles, {.cells = 24, .threads = 1})->data;
    }();
    if (shape == static_cast<std::uint32_t>(ShapeKind::convex)) return convex.blocks();
    if (shape == static_cast<std::uint32_t>(ShapeKind::mesh)) return mesh.blocks();
    return {};
}

}  // namespace weft::cpu
