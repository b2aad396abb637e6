#include "collide/tiles.h"

#include "mesh/procedural.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

namespace weft {
namespace {

struct Mesh {
    std::vector<Vec4> positions;
    std::vector<std::uint32_t> corners;  // as TriangleView has them
    std::uint32_t count = 0;

    TriangleView view() const { return {corners.data(), count, count}; }
};

Mesh mesh_of(const std::vector<Vec3>& positions, const std::vector<Triangle>& triangles) {
    Mesh mesh;
    for (const Vec3& p : positions) mesh.positions.push_back({p.x, p.y, p.z, 1});
    mesh.count = static_cast<std::uint32_t>(triangles.size());
    for (int k = 0; k < 3; ++k)
        for (const Triangle& t : triangles) mesh.corners.push_back(t[k]);
    return mesh;
}

Mesh sheet(std::uint32_t side) {
    const TriangleMesh grid = make_grid({1, 1}, {side, side}, GridDiagonal::alternating);
    return mesh_of(grid.positions, grid.triangles);
}

// Every feature is owned once, and the tiles' numbers name it.
void expect_partition(const Mesh& mesh) {
    using Edge = std::pair<std::uint32_t, std::uint32_t>;
    std::multiset<std::array<std::uint32_t, 3>> triangles, expected_triangles;
    std::multiset<Edge> edges;
    std::set<Edge> expected_edges;
    std::multiset<std::uint32_t> vertices;
    std::set<std::uint32_t> expected_vertices;
    const auto sorted = [](std::array<std::uint32_t, 3> t) {
        std::ranges::sort(t);
        return t;
    };
    for (const Triangle t : mesh.view()) {
        expected_triangles.insert(sorted({t[0], t[1], t[2]}));
        for (int k = 0; k < 3; ++k) {
            expected_vertices.insert(t[k]);
            expected_edges.insert(std::minmax(t[k], t[(k + 1) % 3]));
        }
    }
    for (const Tile& tile : make_tiles(mesh.view(), mesh.positions)) {
        ASSERT_LE(tile.vertex_count, tile_vertices);
        ASSERT_LE(tile.edge_count, tile_edges);
        ASSERT_LE(tile.triangle_count, tile_triangles);
        for (std::uint32_t i = 0; i < tile.own_vertices; ++i) vertices.insert(tile.particle[i]);
        for (std::uint32_t i = 0; i < tile.edge_count; ++i)
            edges.insert(std::minmax(tile.particle[tile.edge[0][i]], tile.particle[tile.edge[1][i]]));
        for (std::uint32_t i = 0; i < tile.triangle_count; ++i)
            triangles.insert(sorted({tile.particle[tile.triangle[0][i]], tile.particle[tile.triangle[1][i]],
                                     tile.particle[tile.triangle[2][i]]}));
    }
    EXPECT_EQ(triangles, expected_triangles);
    EXPECT_TRUE(std::ranges::equal(edges, expected_edges));
    EXPECT_TRUE(std::ranges::equal(vertices, expected_vertices));
}

TEST(Tiles, own_every_feature_once) {
    expect_partition(sheet(2));
    expect_partition(sheet(40));
    const TriangleMesh sphere = make_sphere(0.5f, 3);
    expect_partition(mesh_of(sphere.positions, sphere.triangles));
}

TEST(Tiles, of_a_sheet_are_full) {
    const Mesh mesh = sheet(65);
    EXPECT_EQ(make_tiles(mesh.view(), mesh.positions).size(), 64u * 64 * 2 / tile_triangles);
}

TEST(Tiles, of_triangles_that_share_nothing) {
    std::mt19937 random(1);
    std::vector<Vec3> positions;
    std::vector<Triangle> triangles;
    for (std::uint32_t t = 0; t < 200; ++t) {
        for (int k = 0; k < 3; ++k)
            positions.push_back({float(random() % 100), float(random() % 100), float(random() % 100)});
        triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
    }
    expect_partition(mesh_of(positions, triangles));
}

TEST(Tiles, of_a_fan_with_many_triangles_at_one_edge) {
    std::vector<Vec3> positions{{0, 0, 0}, {1, 0, 0}};
    std::vector<Triangle> triangles;
    for (std::uint32_t i = 0; i < 500; ++i) {
        positions.push_back({0.5f, std::sin(0.01f * float(i)), std::cos(0.01f * float(i))});
        triangles.push_back({0, 1, i + 2});
    }
    expect_partition(mesh_of(positions, triangles));
}

TEST(Tiles, of_points_at_one_place_and_of_nothing) {
    std::vector<Triangle> triangles;
    for (std::uint32_t i = 0; i + 2 < 100; ++i) triangles.push_back({i, i + 1, i + 2});
    expect_partition(mesh_of(std::vector<Vec3>(100, Vec3{1, 2, 3}), triangles));
    EXPECT_TRUE(make_tiles({}, {}).empty());
    const Mesh folded = mesh_of({{0, 0, 0}, {1, 0, 0}}, {{0, 1, 1}, {0, 0, 0}});
    EXPECT_TRUE(make_tiles(folded.view(), folded.positions).empty());
}

}  // namespace
}  // namespace weft
