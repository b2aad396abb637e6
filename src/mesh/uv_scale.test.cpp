#include "mesh/uv_scale.h"

#include "mesh/procedural.h"

#include <gtest/gtest.h>

namespace weft {
namespace {

TEST(UvScale, OfASheetIsItsSize) {
    const auto scale = uv_meters(make_grid({3, 0.5f}, {7, 4}, GridDiagonal::alternating));
    EXPECT_NEAR(scale[0], 3, 1e-5);
    EXPECT_NEAR(scale[1], 0.5, 1e-5);
}

TEST(UvScale, IsTheSameHoweverUvsAreTurnedOrMirrored) {
    TriangleMesh mesh = make_grid({2, 2}, {5, 5}, GridDiagonal::alternating);
    for (Vec2& uv : mesh.uvs) uv = {0.6f * uv.x - 0.8f * uv.y, -0.8f * uv.x - 0.6f * uv.y};
    const auto scale = uv_meters(mesh);
    EXPECT_NEAR(scale[0], 2, 1e-5);
    EXPECT_NEAR(scale[1], 2, 1e-5);
}

TEST(UvScale, IsAMeanOverTheArea) {
    // Two triangles apart: one of area 8 with 4 m a unit, one of area 0.5 with 1 m a unit.
    TriangleMesh mesh;
    mesh.positions = {{0, 0, 0}, {4, 0, 0}, {0, 0, 4}, {9, 0, 0}, {10, 0, 0}, {9, 0, 1}};
    mesh.uvs = {{0, 0}, {1, 0}, {0, 1}, {0, 0}, {1, 0}, {0, 1}};
    mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
    const auto scale = uv_meters(mesh);
    EXPECT_NEAR(scale[0], (8 * 4 + 0.5 * 1) / 8.5, 1e-5);
    EXPECT_NEAR(scale[1], (8 * 4 + 0.5 * 1) / 8.5, 1e-5);
}

TEST(UvScale, WithoutUsefulUvsIsOne) {
    TriangleMesh mesh = make_grid({3, 3}, {4, 4}, GridDiagonal::alternating);
    const TriangleMesh sheet = mesh;
    mesh.uvs.clear();
    EXPECT_EQ(uv_meters(mesh), (std::array<float, 2>{1, 1}));
    mesh.uvs.assign(mesh.positions.size(), {0.5f, 0.5f});
    EXPECT_EQ(uv_meters(mesh), (std::array<float, 2>{1, 1}));
    mesh.uvs = sheet.uvs;
    for (Vec2& uv : mesh.uvs) uv.y = uv.x;  // a line
    EXPECT_EQ(uv_meters(mesh), (std::array<float, 2>{1, 1}));
    EXPECT_EQ(uv_meters({}), (std::array<float, 2>{1, 1}));
}

TEST(UvScale, LeavesOutTrianglesWhoseUvsAreALine) {
    TriangleMesh mesh = make_grid({3, 3}, {3, 3}, GridDiagonal::alternating);
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), {{0, 5, 0}, {9, 5, 0}, {0, 5, 9}});
    mesh.uvs.insert(mesh.uvs.end(), {{0, 0}, {1, 1}, {0.5f, 0.5f}});
    mesh.triangles.push_back({first, first + 1, first + 2});
    EXPECT_NEAR(uv_meters(mesh)[0], 3, 1e-5);
}

}  // namespace
}  // namespace weft
