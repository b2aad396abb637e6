// Degenerate meshes, and meshes with seams. Tests only.
#pragma once

#include "mesh/triangle_mesh.h"

#include <cmath>
#include <map>
#include <numbers>
#include <utility>

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

/// Gives each group of triangles its own vertices, at the same positions. UVs of group g are moved by (g, 0), so that
/// they differ along the seams. `group_of(center)`: the group of a triangle, from its center.
template <class GroupOf>
TriangleMesh with_seams(const TriangleMesh& mesh, GroupOf&& group_of) {
    TriangleMesh split;
    std::map<std::pair<int, std::uint32_t>, std::uint32_t> made;
    for (const Triangle& triangle : mesh.triangles) {
        const Vec3 sum = mesh.positions[triangle[0]] + mesh.positions[triangle[1]] + mesh.positions[triangle[2]];
        const int group = group_of(sum * (1.0f / 3));
        Triangle own{};
        for (std::size_t k = 0; k < 3; ++k) {
            const auto [at, is_new] =
                made.try_emplace({group, triangle[k]}, static_cast<std::uint32_t>(split.positions.size()));
            own[k] = at->second;
            if (!is_new) continue;
            split.positions.push_back(mesh.positions[triangle[k]]);
            const Vec2 uv = mesh.uvs.empty() ? Vec2{mesh.positions[triangle[k]].x, mesh.positions[triangle[k]].z}
                                             : mesh.uvs[triangle[k]];
            split.uvs.push_back({uv.x + static_cast<float>(group), uv.y});
            split.colors.push_back({static_cast<float>(group & 1), 0.5f, 0, 1});
        }
        split.triangles.push_back(own);
    }
    return split;
}

}  // namespace weft::testing_meshes
