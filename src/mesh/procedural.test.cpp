#include "mesh/procedural.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
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
    EXPECT_EQ(mesh.uvs[0], (Vec2{0, 0}));
    EXPECT_EQ(mesh.uvs[1], (Vec2{0.5f, 0}));
    EXPECT_EQ(mesh.uvs[11], (Vec2{1, 1}));
    for (const Vec3 n : mesh.normals) EXPECT_EQ(n, (Vec3{0, 1, 0}));
}

TEST(Grid, uv_is_the_place_in_the_sheet) {
    for (const auto diagonal : all_diagonals) {
        const auto mesh = make_grid({0.7f, 1.3f}, {9, 6}, diagonal);
        for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
            EXPECT_NEAR(mesh.uvs[i].x * 0.7f - 0.35f, mesh.positions[i].x, 1e-6f);
            EXPECT_NEAR(mesh.uvs[i].y * 1.3f - 0.65f, mesh.positions[i].z, 1e-6f);
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

}  // namespace
}  // namespace weft
