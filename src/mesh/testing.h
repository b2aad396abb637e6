// Degenerate meshes. Tests only.
#pragma once

#include "mesh/triangle_mesh.h"

#include <cmath>
#include <numbers>

namespace weft::testing_meshes {

/// Adds a triangle with three new vertices.
inline void add_triangle(TriangleMesh& mesh, Vec3 a, Vec3 b, Vec3 c) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), {a, b, c});
    mesh.triangles.push_back({first, first + 1, first + 2});
}

/// `rim` triangles around a hub, vertex 0, out to a circle of 1 m.
inline TriangleMesh fan(std::uint32_t rim) {
    TriangleMesh mesh;
    mesh.positions.push_back({});
    for (std::uint32_t i = 0; i < rim; ++i) {
        const double angle = 2 * std::numbers::pi * i / rim;
        mesh.positions.push_back({static_cast<float>(std::cos(angle)), 0, static_cast<float>(std::sin(angle))});
        mesh.triangles.push_back({0, 1 + (i + 1) % rim, 1 + i});
    }
    return mesh;
}

/// `pages` strips of 2 × `rows` vertices that share one edge, vertices 0 and 1.
inline TriangleMesh book(std::uint32_t pages, std::uint32_t rows) {
    TriangleMesh mesh;
    mesh.positions = {{0, 0, 0}, {0, 0, 0.1f}};
    for (std::uint32_t page = 0; page < pages; ++page) {
        const double angle = 2 * std::numbers::pi * page / pages;
        const auto x = static_cast<float>(0.1 * std::cos(angle)), y = static_cast<float>(0.1 * std::sin(angle));
        std::uint32_t before = 0;
        for (std::uint32_t row = 1; row < rows; ++row) {
            const auto a = static_cast<std::uint32_t>(mesh.positions.size());
            const auto f = static_cast<float>(row);
            mesh.positions.insert(mesh.positions.end(), {{f * x, f * y, 0}, {f * x, f * y, 0.1f}});
            mesh.triangles.insert(mesh.triangles.end(), {{before, before + 1, a}, {before + 1, a + 1, a}});
            before = a;
        }
    }
    return mesh;
}

/// Disconnected triangles.
inline TriangleMesh pieces(std::uint32_t count) {
    TriangleMesh mesh;
    for (std::uint32_t i = 0; i < count; ++i) {
        const auto x = static_cast<float>(i);
        add_triangle(mesh, {x, 0, 0}, {x, 0, 0.5f}, {x + 0.5f, 0, 0});
    }
    return mesh;
}

}  // namespace weft::testing_meshes
