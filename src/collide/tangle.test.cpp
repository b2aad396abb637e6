#include "collide/tangle.h"

#include "collide/crossings.h"
#include "mesh/procedural.h"

#include <gtest/gtest.h>

#include <numbers>

namespace weft {
namespace {

struct Surfaces {
    std::vector<Vec3> positions;
    std::vector<Triangle> triangles;

    std::uint32_t add(const TriangleMesh& mesh, Vec3 (*place)(Vec3)) {
        const auto first = static_cast<std::uint32_t>(positions.size());
        for (const Vec3 p : mesh.positions) positions.push_back(place(p));
        for (const Triangle& t : mesh.triangles) triangles.push_back({first + t[0], first + t[1], first + t[2]});
        return first;
    }
};

TriangleMesh grid(std::array<float, 2> size, std::array<std::uint32_t, 2> resolution) {
    return make_grid(size, resolution, GridDiagonal::alternating);
}

/// A small sheet stands upright in a large flat one; less than half of it, x > 0, is below.
Surfaces small_through_large() {
    Surfaces surfaces;
    surfaces.add(grid({2, 2}, {9, 9}), [](Vec3 p) { return p; });
    surfaces.add(grid({0.5f, 0.5f}, {6, 6}), [](Vec3 p) { return Vec3{p.z + 0.03f, 0.08f - p.x, 0.01f}; });
    return surfaces;
}

TEST(Tangle, surfaces_that_do_not_meet_are_not_tangled) {
    Surfaces surfaces;
    surfaces.add(grid({1, 1}, {5, 5}), [](Vec3 p) { return p; });
    surfaces.add(grid({1, 1}, {5, 5}), [](Vec3 p) { return p + Vec3{0, 0.1f, 0}; });
    const Tangle tangle = find_tangle(surfaces.positions, surfaces.triangles);
    EXPECT_TRUE(tangle.pairs.empty());
    EXPECT_TRUE(tangle.first.empty());
    EXPECT_TRUE(find_tangle({}, {}).pairs.empty());
}

TEST(Tangle, all_crossings_are_found) {
    const Surfaces surfaces = small_through_large();
    const Tangle tangle = find_tangle(surfaces.positions, surfaces.triangles);
    EXPECT_GT(tangle.pairs.size(), 5u);
    EXPECT_EQ(tangle.pairs.size(), count_crossings(surfaces.positions, surfaces.triangles).edges);
}

TEST(Tangle, surfaces_that_cannot_cross_are_not_tangled) {
    const Surfaces surfaces = small_through_large();
    const TangleRules rules{.can_cross = [](std::uint32_t p, std::uint32_t q) { return (p < 81) == (q < 81); }};
    EXPECT_TRUE(find_tangle(surfaces.positions, surfaces.triangles, rules).pairs.empty());
}

TEST(Tangle, features_that_are_tied_are_not_tangled) {
    const Surfaces surfaces = small_through_large();
    const std::vector<TangledPair> all = find_tangle(surfaces.positions, surfaces.triangles).pairs;
    const auto [a, b, c, d, e] = all.front().particle;
    const TangleRules rules{.tied = [&](std::uint32_t p, std::uint32_t q) { return p == a && q == c; }};
    const std::vector<TangledPair> left = find_tangle(surfaces.positions, surfaces.triangles, rules).pairs;
    EXPECT_LT(left.size(), all.size());
    EXPECT_FALSE(left.empty());
    for (const TangledPair& pair : left) {
        const bool of_a = pair.particle[0] == a || pair.particle[1] == a;
        EXPECT_FALSE(of_a && std::find(&pair.particle[2], &pair.particle[4] + 1, c) != &pair.particle[4] + 1);
    }
}

TEST(Tangle, an_order_decides_instead_of_the_size_of_parts) {
    const Surfaces surfaces = small_through_large();
    for (const int small_in_front : {1, -1}) {
        const TangleRules rules{.order = [&](std::uint32_t p, std::uint32_t q) {
            return (p < 81) == (q < 81) ? 0 : p < 81 ? -small_in_front : small_in_front;
        }};
        for (const TangledPair& pair : find_tangle(surfaces.positions, surfaces.triangles, rules).pairs) {
            const bool small_passes = pair.particle[0] >= 81;
            // In front of the large sheet is above it; in front of the small one, beside it.
            if (small_in_front > 0)
                EXPECT_NEAR(pair.direction.y, small_passes ? 1 : -1, 1e-5);
            else
                EXPECT_NEAR(std::abs(pair.direction.z), 1, 1e-5);
        }
    }
}

TEST(Tangle, the_smaller_part_is_drawn_back) {
    const Surfaces surfaces = small_through_large();
    const auto first_of_small = static_cast<std::uint32_t>(81);
    for (const TangledPair& pair : find_tangle(surfaces.positions, surfaces.triangles).pairs) {
        // Relative to the large sheet, the small one has to go up.
        const float up = pair.particle[0] >= first_of_small ? 1.0f : -1.0f;
        EXPECT_NEAR(pair.direction.y, up, 1e-5);
    }
}

TEST(Tangle, two_corners_go_the_shortest_way) {
    Surfaces surfaces;
    surfaces.add(grid({1, 1}, {11, 11}), [](Vec3 p) { return p; });
    // Its front corner is below the other sheet, near that sheet's middle.
    surfaces.add(grid({1, 1}, {11, 11}), [](Vec3 p) {
        const float along = (p.x + p.z) * 0.7071f, across = (p.x - p.z) * 0.7071f;
        return Vec3{0.02f + 0.6f * along, 0.35f - 0.8f * along, across + 0.01f};
    });
    const Tangle tangle = find_tangle(surfaces.positions, surfaces.triangles);
    ASSERT_FALSE(tangle.pairs.empty());
    for (const TangledPair& pair : tangle.pairs)
        EXPECT_GT(pair.direction.y * (pair.particle[0] >= 121 ? 1.0f : -1.0f), 0.9f);
}

TEST(Tangle, only_features_on_both_sides_of_a_crossing_are_joined) {
    const Surfaces surfaces = small_through_large();
    const Tangle tangle = find_tangle(surfaces.positions, surfaces.triangles);
    for (const TangledPair& pair : tangle.pairs) {
        for (int i = 0; i < 2; ++i)
            for (int k = 2; k < 5; ++k) {
                EXPECT_TRUE(tangle.joins(pair.particle[i], pair.particle[k]));
                EXPECT_TRUE(tangle.joins(pair.particle[k], pair.particle[i]));
            }
    }
    EXPECT_FALSE(tangle.joins(0, 100)) << "a corner of the large sheet is far from the small one";
    for (std::uint32_t p = 0; p < 81; ++p)
        for (std::uint32_t q = 0; q < 81; ++q) EXPECT_FALSE(tangle.joins(p, q)) << "both are in the large sheet";
}

TEST(Tangle, degenerate_triangles_and_numbers_without_particles_are_left_out) {
    Surfaces surfaces = small_through_large();
    const std::size_t pairs = find_tangle(surfaces.positions, surfaces.triangles).pairs.size();
    surfaces.positions.resize(surfaces.positions.size() + 7);
    surfaces.triangles.push_back({3, 3, 4});
    surfaces.triangles.push_back({100, 100, 100});
    const Tangle tangle = find_tangle(surfaces.positions, surfaces.triangles);
    EXPECT_EQ(tangle.pairs.size(), pairs);
    for (const TangledPair& pair : tangle.pairs) EXPECT_TRUE(finite(pair.direction));
}

}  // namespace
}  // namespace weft
