#include "mesh/procedural.h"

#include "mesh/topology.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <numbers>
#include <set>

namespace weft {
namespace {

constexpr std::array all_diagonals{GridDiagonal::uniform, GridDiagonal::alternating, GridDiagonal::cross};

Vec3 doubled_area(const TriangleMesh& mesh, const Triangle& t) {
    const Vec3 a = mesh.positions[t[0]];
    return cross(mesh.positions[t[1]] - a, mesh.positions[t[2]] - a);
}

TEST(Grid, counts) {
    for (const auto& [nx, nz] : {std::array{2u, 2u}, std::array{5u, 3u}, std::array{3u, 17u}}) {
        const std::size_t cells = (nx - 1) * (nz - 1);
        for (const auto diagonal : all_diagonals) {
            const auto mesh = make_grid({1, 1}, {nx, nz}, diagonal);
            const bool cross = diagonal == GridDiagonal::cross;
            EXPECT_EQ(mesh.positions.size(), nx * nz + (cross ? cells : 0));
            EXPECT_EQ(mesh.uvs.size(), mesh.positions.size());
            EXPECT_EQ(mesh.normals.size(), mesh.positions.size());
            EXPECT_EQ(mesh.triangles.size(), cells * (cross ? 4 : 2));
        }
    }
}

TEST(Grid, vertices_row_by_row_and_centered) {
    const auto mesh = make_grid({2, 6}, {3, 4}, GridDiagonal::uniform);
    EXPECT_EQ(mesh.positions[0], (Vec3{-1, 0, -3}));
    EXPECT_EQ(mesh.positions[2], (Vec3{1, 0, -3}));
    EXPECT_EQ(mesh.positions[9], (Vec3{-1, 0, 3}));
    EXPECT_EQ(mesh.positions[11], (Vec3{1, 0, 3}));
    EXPECT_EQ(mesh.uvs[0], (Vec2{0, 1}));
    EXPECT_EQ(mesh.uvs[1], (Vec2{0.5f, 1}));
    EXPECT_EQ(mesh.uvs[11], (Vec2{1, 0}));
    for (const Vec3 n : mesh.normals) EXPECT_EQ(n, (Vec3{0, 1, 0}));
}

// Seen from +y with -z at the top, u runs to the right and v upward.
TEST(Grid, an_image_on_it_is_upright_and_not_mirrored) {
    for (const auto diagonal : all_diagonals) {
        const auto mesh = make_grid({0.7f, 1.3f}, {9, 6}, diagonal);
        for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
            EXPECT_NEAR(mesh.uvs[i].x * 0.7f - 0.35f, mesh.positions[i].x, 1e-6f);
            EXPECT_NEAR(0.65f - mesh.uvs[i].y * 1.3f, mesh.positions[i].z, 1e-6f);
        }
    }
}

TEST(Grid, faces_up_and_covers_its_size_once) {
    for (const auto diagonal : all_diagonals) {
        const auto mesh = make_grid({2, 3}, {6, 8}, diagonal);
        double area = 0;
        for (const Triangle& t : mesh.triangles) {
            const Vec3 n = doubled_area(mesh, t);
            EXPECT_GT(n.y, 0);
            area += n.y / 2;
        }
        EXPECT_NEAR(area, 6, 1e-5);
    }
}

/// The diagonals as (cell x, cell z, runs along +x+z).
std::set<std::array<std::uint32_t, 3>> diagonals_of(const TriangleMesh& mesh, std::uint32_t nx) {
    std::set<std::array<std::uint32_t, 3>> found;
    for (const Triangle& t : mesh.triangles)
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t a = std::min(t[k], t[(k + 1) % 3]), b = std::max(t[k], t[(k + 1) % 3]);
            if (b == a + nx + 1) found.insert({a % nx, a / nx, 1});
            if (b == a + nx - 1 && a % nx != 0) found.insert({a % nx - 1, a / nx, 0});
        }
    return found;
}

TEST(Grid, diagonals) {
    const auto uniform = diagonals_of(make_grid({1, 1}, {7, 5}, GridDiagonal::uniform), 7);
    EXPECT_EQ(uniform.size(), 24u);
    for (const auto& [x, z, along] : uniform) EXPECT_EQ(along, 1u);
    const auto alternating = diagonals_of(make_grid({1, 1}, {7, 5}, GridDiagonal::alternating), 7);
    EXPECT_EQ(alternating.size(), 24u);
    for (const auto& [x, z, along] : alternating) EXPECT_EQ(along, (x + z) % 2 == 0 ? 1u : 0u);
}

TEST(Grid, cross_has_a_vertex_in_the_middle_of_each_cell) {
    const std::uint32_t nx = 4, nz = 3;
    const auto mesh = make_grid({3, 2}, {nx, nz}, GridDiagonal::cross);
    for (std::uint32_t cz = 0; cz + 1 < nz; ++cz)
        for (std::uint32_t cx = 0; cx + 1 < nx; ++cx) {
            const std::uint32_t m = nx * nz + cz * (nx - 1) + cx;
            const Vec3 corners = mesh.positions[cz * nx + cx] + mesh.positions[(cz + 1) * nx + cx + 1];
            EXPECT_NEAR(length(mesh.positions[m] - corners * 0.5f), 0, 1e-6f);
            int around = 0;
            for (const Triangle& t : mesh.triangles) around += t[0] == m || t[1] == m || t[2] == m;
            EXPECT_EQ(around, 4);
        }
}

struct Measure {
    double area = 0, volume = 0, least_triangle = 1e30, greatest_triangle = 0;
};

/// The volume is right for a closed surface only, and positive if its triangles face outward.
Measure measure(const TriangleMesh& mesh) {
    Measure sum;
    for (const Triangle& t : mesh.triangles) {
        const Vec3 n = doubled_area(mesh, t);
        const double area = static_cast<double>(length(n)) / 2;
        sum.area += area;
        sum.least_triangle = std::min(sum.least_triangle, area);
        sum.greatest_triangle = std::max(sum.greatest_triangle, area);
        sum.volume += static_cast<double>(dot(mesh.positions[t[0]], n)) / 6;
    }
    return sum;
}

/// Each vertex is a separate particle, each edge has two triangles that wind it in opposite ways, and the mesh is one
/// piece without handles (Euler: V - E + F = 2).
void expect_closed_and_welded(const TriangleMesh& mesh) {
    const auto topology = build_topology(mesh);
    ASSERT_TRUE(topology.ok());
    EXPECT_EQ(topology->report.welded_vertices, 0u);
    EXPECT_EQ(topology->report.isolated_vertices, 0u);
    EXPECT_EQ(topology->report.degenerate_triangles, 0u);
    EXPECT_EQ(topology->report.duplicate_triangles, 0u);
    EXPECT_EQ(topology->report.non_manifold_edges, 0u);
    EXPECT_EQ(topology->report.inconsistent_edges, 0u);
    EXPECT_EQ(topology->hinges.size(), topology->edges.size());
    EXPECT_EQ(topology->particle_count + topology->triangles.size() - topology->edges.size(), 2u);
}

TEST(Sphere, is_closed_and_welded) {
    for (const std::uint32_t subdivisions : {0u, 1u, 3u, 5u}) {
        const auto mesh = make_sphere(0.3f, subdivisions);
        EXPECT_EQ(mesh.positions.size(), (10u << 2 * subdivisions) + 2);
        EXPECT_EQ(mesh.triangles.size(), 20u << 2 * subdivisions);
        expect_closed_and_welded(mesh);
    }
}

TEST(Sphere, is_round) {
    const auto mesh = make_sphere(2, 6);
    ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        EXPECT_NEAR(length(mesh.positions[v]), 2, 4e-7f);
        EXPECT_LT(length(mesh.positions[v] - mesh.normals[v] * 2), 5e-7f);
    }
}

TEST(Sphere, comes_to_the_area_and_volume_of_the_ball_from_within) {
    const double area = 4 * std::numbers::pi * 0.25, volume = 4 * std::numbers::pi / 3 * 0.125;
    double missing_area = area, missing_volume = volume;
    for (std::uint32_t subdivisions = 0; subdivisions <= 6; ++subdivisions) {
        const Measure ball = measure(make_sphere(0.5f, subdivisions));
        // Flat triangles miss a part of area and volume proportional to the square of their size: a quarter after each
        // cut.
        const double at_most = subdivisions == 0 ? 0.5 : 0.35;
        EXPECT_GT(area - ball.area, 0);
        EXPECT_GT(volume - ball.volume, 0);
        EXPECT_LT(area - ball.area, at_most * missing_area);
        EXPECT_LT(volume - ball.volume, at_most * missing_volume);
        missing_area = area - ball.area, missing_volume = volume - ball.volume;
    }
    EXPECT_LT(missing_area, 3e-4 * area);
    EXPECT_LT(missing_volume, 6e-4 * volume);
}

TEST(Sphere, has_triangles_of_nearly_one_size) {
    for (std::uint32_t subdivisions = 0; subdivisions <= 6; ++subdivisions) {
        const Measure ball = measure(make_sphere(1, subdivisions));
        EXPECT_LT(ball.greatest_triangle, 1.33 * ball.least_triangle)
            << subdivisions << ": " << ball.greatest_triangle / ball.least_triangle;
    }
}

TEST(Box, is_closed_and_welded) {
    for (const std::array<std::uint32_t, 3> n : {std::array{2u, 2u, 2u}, {3u, 2u, 5u}, {2u, 9u, 2u}, {7u, 8u, 9u}}) {
        const auto mesh = make_box({0.3f, 1.7f, 0.9f}, n);
        const std::uint32_t x = n[0] - 1, y = n[1] - 1, z = n[2] - 1;
        EXPECT_EQ(mesh.positions.size(), 2 * (x * y + y * z + z * x) + 2);
        EXPECT_EQ(mesh.triangles.size(), 4 * (x * y + y * z + z * x));
        expect_closed_and_welded(mesh);
    }
}

TEST(Box, has_its_area_and_volume) {
    const Measure box = measure(make_box({1, 2, 3}, {6, 5, 4}));
    EXPECT_NEAR(box.area, 22, 1e-4);
    EXPECT_NEAR(box.volume, 6, 1e-5);
    // Cells of 0.2 by 0.5, 0.5 by 1 and 0.2 by 1.
    EXPECT_NEAR(box.least_triangle, 0.05, 1e-6);
    EXPECT_NEAR(box.greatest_triangle, 0.25, 1e-6);
}

TEST(Box, vertices_come_layer_by_layer) {
    const auto mesh = make_box({2, 4, 6}, {3, 4, 3});
    EXPECT_EQ(mesh.positions[0], (Vec3{-1, -2, -3}));
    EXPECT_EQ(mesh.positions[2], (Vec3{1, -2, -3}));
    EXPECT_EQ(mesh.positions[8], (Vec3{1, -2, 3}));
    EXPECT_EQ(mesh.positions[12].x, -1);  // the ring above: three, then two at its sides
    EXPECT_EQ(mesh.positions[12].z, 0);
    EXPECT_EQ(mesh.positions[13].x, 1);
    EXPECT_EQ(mesh.positions.back(), (Vec3{1, 2, 3}));
    EXPECT_TRUE(std::is_sorted(mesh.positions.begin(), mesh.positions.end(), [](Vec3 a, Vec3 b) {
        return std::array{a.y, a.z, a.x} < std::array{b.y, b.z, b.x};
    }));
}

}  // namespace
}  // namespace weft
