// The surface of a distance field against the field as contact reads it.
#include "collide/field_surface.h"

#include "collide/field_reading.test.h"
#include "mesh/procedural.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>

namespace weft {
namespace {

/// Edges that are not used as often in one direction as in the other.
std::size_t open_edges(const TriangleMesh& mesh) {
    std::map<std::array<std::uint32_t, 2>, int> balance;
    for (const Triangle& t : mesh.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t a = t[k], b = t[(k + 1) % 3];
            balance[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
        }
    }
    return static_cast<std::size_t>(std::ranges::count_if(balance, [](const auto& e) { return e.second != 0; }));
}

double volume_of(const TriangleMesh& mesh) {
    double volume = 0;
    for (const auto& [a, b, c] : mesh.triangles)
        volume += double{dot(mesh.positions[a], cross(mesh.positions[b], mesh.positions[c]))} / 6;
    return volume;
}

/// Two boxes that overlap, turned: faces, edges and corners in all directions.
TriangleMesh crossed_boxes() {
    TriangleMesh mesh = make_box({1.0f, 0.3f, 0.4f}, {2, 2, 2});
    const TriangleMesh other = make_box({0.3f, 0.9f, 0.2f}, {2, 2, 2});
    const float c = 0.8f, s = 0.6f;
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const Vec3 p : other.positions) mesh.positions.push_back({c * p.x - s * p.y, s * p.x + c * p.y, p.z + 0.05f});
    for (const auto& [i, j, k] : other.triangles) mesh.triangles.push_back({i + first, j + first, k + first});
    return mesh;
}

TEST(FieldSurface, lies_where_the_field_is_zero) {
    for (const TriangleMesh& solid : {make_sphere(0.2f, 3), make_box({0.3f, 0.2f, 0.1f}, {2, 2, 2}), crossed_boxes()}) {
        const DistanceField field = field_of(solid, 32);
        EXPECT_EQ(cell_of_field(field.data), field.cell);
        const TriangleMesh surface = zero_surface_of_field(field.data);
        ASSERT_GT(surface.triangles.size(), 1000u);
        ASSERT_EQ(surface.normals.size(), surface.positions.size());
        double between = 0, mean = 0;
        for (const Vec3 p : surface.positions) ASSERT_LT(std::abs(read(field, p).distance), 1e-3f * field.cell);
        for (const auto& [a, b, c] : surface.triangles) {
            const Vec3 middle = (surface.positions[a] + surface.positions[b] + surface.positions[c]) / 3;
            const double distance = std::abs(double{read(field, middle).distance}) / double{field.cell};
            between = std::max(between, distance);
            mean += distance / static_cast<double>(surface.triangles.size());
        }
        EXPECT_LT(between, 0.3) << "triangles are flat; most differs in the corner between two boxes";
        EXPECT_LT(mean, 0.01);
    }
}

TEST(FieldSurface, is_closed_and_faces_outward) {
    for (const std::uint32_t cells : {8u, 33u, 64u}) {
        const TriangleMesh solid = crossed_boxes();
        const DistanceField field = field_of(solid, cells);
        const TriangleMesh surface = zero_surface_of_field(field.data);
        EXPECT_EQ(open_edges(surface), 0u) << cells;
        // All but some in the corner between the boxes.
        std::size_t inward = 0;
        for (std::size_t v = 0; v < surface.positions.size(); ++v)
            inward += !(read(field, surface.positions[v] + surface.normals[v] * (0.1f * field.cell)).distance > 0);
        EXPECT_LT(inward, surface.positions.size() / 50) << cells;
    }
    // A ball holds what a ball holds: no part is missing or turned around.
    const DistanceField ball = field_of(make_sphere(0.2f, 4), 48);
    EXPECT_NEAR(volume_of(zero_surface_of_field(ball.data)), 4.18879 * 0.008, 0.02 * 4.18879 * 0.008);
}

// Coordinates of nodes are those of the faces, so that many values are exactly 0.
TEST(FieldSurface, is_closed_where_values_are_zero) {
    const DistanceField field = field_of(make_box({0.5f, 0.5f, 0.5f}, {2, 2, 2}), 16);
    const TriangleMesh surface = zero_surface_of_field(field.data);
    EXPECT_EQ(open_edges(surface), 0u);
    EXPECT_NEAR(volume_of(surface), 0.125, 0.004);
}

TEST(FieldSurface, closes_holes_and_sheets) {
    TriangleMesh bowl = make_sphere(0.2f, 3);
    std::erase_if(bowl.triangles, [&](const Triangle& t) { return bowl.positions[t[0]].y > 0.1f; });
    const TriangleMesh closed = zero_surface_of_field(field_of(bowl, 32).data);
    EXPECT_EQ(open_edges(closed), 0u);
    EXPECT_GT(volume_of(closed), 0.5 * 4.18879 * 0.008);
    const TriangleMesh sheet =
        zero_surface_of_field(field_of(make_grid({1, 1}, {5, 5}, GridDiagonal::uniform), 64).data);
    EXPECT_EQ(open_edges(sheet), 0u);
    EXPECT_NEAR(volume_of(sheet), 2.0 / 64, 0.004);
}

TEST(FieldSurface, is_coarser_if_it_has_to_be) {
    const DistanceField field = field_of(make_sphere(0.2f, 4), 64);
    const TriangleMesh fine = zero_surface_of_field(field.data);
    const TriangleMesh coarse = zero_surface_of_field(field.data, 3000);
    EXPECT_LT(coarse.triangles.size(), fine.triangles.size() / 3);
    EXPECT_GT(coarse.triangles.size(), 500u);
    EXPECT_EQ(open_edges(coarse), 0u);
    for (const Vec3 p : coarse.positions) ASSERT_LT(std::abs(read(field, p).distance), 1e-2f * field.cell);
}

}  // namespace
}  // namespace weft
