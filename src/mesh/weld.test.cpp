#include "mesh/weld.h"

#include "mesh/triangle_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace weft {
namespace {

/// The definition, implemented literally in quadratic time.
Weld weld_by_search(std::span<const Vec3> positions, float distance) {
    Weld weld;
    for (std::uint32_t v = 0; v < positions.size(); ++v) {
        std::uint32_t joined = none;
        for (std::uint32_t w = 0; w < weld.first_vertex.size() && joined == none; ++w) {
            const Vec3 p = positions[weld.first_vertex[w]], q = positions[v];
            const double x = double{p.x} - q.x, y = double{p.y} - q.y, z = double{p.z} - q.z;
            if (x * x + y * y + z * z <= double{distance} * distance) joined = w;
        }
        if (joined == none) {
            joined = static_cast<std::uint32_t>(weld.first_vertex.size());
            weld.first_vertex.push_back(v);
        }
        weld.vertex_to_welded.push_back(joined);
    }
    return weld;
}

void expect_same(const Weld& got, const Weld& expected) {
    EXPECT_EQ(got.first_vertex, expected.first_vertex);
    EXPECT_EQ(got.vertex_to_welded, expected.vertex_to_welded);
}

std::vector<Vec3> random_points(std::uint32_t seed, std::size_t count, float scale, Vec3 offset = {}) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> in(-1, 1);
    std::vector<Vec3> points(count);
    for (Vec3& p : points) {
        const float x = in(random), y = in(random), z = in(random);
        p = Vec3{x, y, z} * scale + offset;
    }
    return points;
}

TEST(Weld, nothing) {
    EXPECT_TRUE(weld_vertices({}, 0).vertex_to_welded.empty());
    EXPECT_TRUE(weld_vertices({}, 1).first_vertex.empty());
}

TEST(Weld, exact_joins_equal_positions_and_signed_zeros_only) {
    const float next = std::nextafter(1.0f, 2.0f);
    const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {-0.0f, 0, -0.0f}, {next, 0, 0}, {0, 1, 0}, {1, -0.0f, 0}};
    const Weld weld = weld_vertices(points, 0);
    EXPECT_EQ(weld.vertex_to_welded, (std::vector<std::uint32_t>{0, 1, 0, 2, 3, 1}));
    EXPECT_EQ(weld.first_vertex, (std::vector<std::uint32_t>{0, 1, 3, 4}));
}

TEST(Weld, exact_matches_search_on_many_repeats) {
    std::mt19937 random(3);
    std::vector<Vec3> points(2000);
    for (Vec3& p : points) {
        const auto small = [&] { return static_cast<float>(static_cast<int>(random() % 9) - 4); };
        p.x = small(), p.y = small(), p.z = small();
    }
    expect_same(weld_vertices(points, 0), weld_by_search(points, 0));
}

TEST(Weld, distance_includes_its_end_and_nothing_more) {
    const std::vector<Vec3> points{{0, 0, 0}, {0.5f, 0, 0}, {std::nextafter(0.5f, 1.0f), 0, 0}};
    EXPECT_EQ(weld_vertices(points, 0.5f).vertex_to_welded, (std::vector<std::uint32_t>{0, 0, 1}));
}

TEST(Weld, chains_do_not_collapse) {
    std::vector<Vec3> points;
    for (int i = 0; i < 9; ++i) points.push_back({static_cast<float>(i), 0, 0});
    EXPECT_EQ(weld_vertices(points, 1).vertex_to_welded, (std::vector<std::uint32_t>{0, 0, 1, 1, 2, 2, 3, 3, 4}));
}

TEST(Weld, joins_the_earliest_not_the_nearest) {
    const std::vector<Vec3> points{{0, 0, 0}, {1.5f, 0, 0}, {0.9f, 0, 0}};
    EXPECT_EQ(weld_vertices(points, 1).vertex_to_welded, (std::vector<std::uint32_t>{0, 1, 0}));
}

TEST(Weld, distance_matches_search) {
    for (const float distance : {0.01f, 0.05f, 0.2f, 0.9f, 3.0f}) {
        SCOPED_TRACE(distance);
        expect_same(weld_vertices(random_points(7, 1500, 1), distance),
                    weld_by_search(random_points(7, 1500, 1), distance));
    }
}

TEST(Weld, distance_matches_search_far_from_the_origin) {
    // The spacing of floats is close to the distance here, so cells and coordinates have similar rounding errors.
    const auto points = random_points(11, 1500, 0.01f, {1e4f, -1e4f, 3});
    for (const float distance : {0.0005f, 0.000976f, 0.0009765625f, 0.001f, 0.002f}) {
        SCOPED_TRACE(distance);
        expect_same(weld_vertices(points, distance), weld_by_search(points, distance));
    }
}

TEST(Weld, neighbors_on_a_lattice_of_the_distance) {
    // Every coordinate is on a border between cells of this width.
    std::vector<Vec3> points;
    for (int i = -60; i <= 60; ++i)
        points.push_back({static_cast<float>(i) * 0.1f, static_cast<float>(i % 3) * 0.1f, 0});
    for (const float distance : {0.1f, 0.2f, 0.05f})
        expect_same(weld_vertices(points, distance), weld_by_search(points, distance));
}

TEST(Weld, absurd_distances) {
    auto points = random_points(5, 20000, 1);
    points.push_back({3e38f, -3e38f, 3e38f});
    points.push_back({1e-45f, 0, 0});
    points.push_back({0, 0, 0});
    const float infinity = std::numeric_limits<float>::infinity();
    for (const float tiny : {std::numeric_limits<float>::denorm_min(), 1e-38f, 1e-30f}) {
        const Weld weld = weld_vertices(points, tiny);
        // Only the last two, a denormal apart, are near each other.
        EXPECT_EQ(weld.first_vertex.size(), points.size() - 1) << tiny;
        EXPECT_EQ(weld.vertex_to_welded[points.size() - 1], weld.vertex_to_welded[points.size() - 2]) << tiny;
    }
    EXPECT_EQ(weld_vertices(points, 1e30f).first_vertex, (std::vector<std::uint32_t>{0, 20000}));
    EXPECT_EQ(weld_vertices(points, infinity).first_vertex, (std::vector<std::uint32_t>{0}));
    EXPECT_EQ(weld_vertices(points, std::numeric_limits<float>::max()).first_vertex.size(), 2u);
}

}  // namespace
}  // namespace weft
