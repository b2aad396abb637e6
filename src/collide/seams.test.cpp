#include "collide/seams.h"

#include <gtest/gtest.h>

#include <cmath>

namespace weft {
namespace {

constexpr std::uint32_t seam_side = 5;

// Two square sheets of 5 × 5 particles, 1 m apart from each other, in the plane y = 0.
std::vector<Vec4> seamed_sheet() {
    std::vector<Vec4> rest;
    for (std::uint32_t row = 0; row < seam_side; ++row)
        for (std::uint32_t column = 0; column < seam_side; ++column)
            rest.push_back({static_cast<float>(column), 0, static_cast<float>(row), 1});
    return rest;
}
const std::vector<Vec4> seamed_one = seamed_sheet(), seamed_two = seamed_sheet();
constexpr std::uint32_t base_one = 32, base_two = 64;

std::uint32_t in_one(std::uint32_t column, std::uint32_t row) {
    return base_one + row * seam_side + column;
}
std::uint32_t in_two(std::uint32_t column, std::uint32_t row) {
    return base_two + row * seam_side + column;
}
StitchPoint stitched_at(std::uint32_t particle) {
    return {.particles = {particle, 0, 0}};
}

Seams seams(std::span<const SeamTie> ties, float thickness) {
    return Seams(ties, std::vector<SeamedCloth>{{seamed_one.data(), base_one, seam_side * seam_side, thickness},
                                                {seamed_two.data(), base_two, seam_side * seam_side, thickness}});
}

// The last column of the first sheet with the first one of the second sheet.
std::vector<SeamTie> edge_to_edge(float gap = 0) {
    std::vector<SeamTie> ties;
    for (std::uint32_t row = 0; row < seam_side; ++row)
        ties.push_back({stitched_at(in_one(4, row)), stitched_at(in_two(0, row)), gap});
    return ties;
}

TEST(Seams, particles_of_a_stitch_are_at_distance_0) {
    const Seams made = seams(edge_to_edge(), 0.01f);
    for (std::uint32_t row = 0; row < seam_side; ++row) EXPECT_EQ(made.distance(in_one(4, row), in_two(0, row)), 0);
    EXPECT_EQ(made.distance(in_two(0, 2), in_one(4, 2)), 0);
    EXPECT_EQ(made.distance(in_one(4, 1), in_two(0, 2)), Seams::far) << "farther than two thicknesses";
    EXPECT_EQ(made.distance(in_one(4, 1), in_one(4, 1)), Seams::far) << "no stitch is between them";
    EXPECT_EQ(made.distance(in_one(3, 1), in_two(0, 1)), Seams::far);
}

TEST(Seams, distances_go_through_the_best_stitch) {
    const Seams made = seams(edge_to_edge(), 2);
    EXPECT_FLOAT_EQ(made.distance(in_one(4, 1), in_two(0, 2)), 1);
    EXPECT_FLOAT_EQ(made.distance(in_one(3, 2), in_two(1, 2)), 2);
    EXPECT_FLOAT_EQ(made.distance(in_one(3, 1), in_two(0, 3)), std::sqrt(5.0f));
    EXPECT_FLOAT_EQ(made.distance(in_one(3, 1), in_two(1, 2)), 1 + std::sqrt(2.0f));
    EXPECT_EQ(made.distance(in_one(0, 0), in_two(0, 4)), Seams::far);
    EXPECT_EQ(made.distance(in_one(1, 1), in_one(2, 1)), Seams::far) << "not through a seam";
}

TEST(Seams, particles_tied_through_others_are_one_point) {
    // Four corners meet: each is tied to the next one only.
    const std::vector<SeamTie> ties{{stitched_at(in_one(0, 0)), stitched_at(in_two(0, 0))},
                                    {stitched_at(in_two(0, 0)), stitched_at(in_one(4, 4))}};
    const Seams made = seams(ties, 0.1f);
    EXPECT_EQ(made.distance(in_one(0, 0), in_one(4, 4)), 0);
    EXPECT_EQ(made.distance(in_one(4, 4), in_two(0, 0)), 0);
}

TEST(Seams, all_particles_with_a_share_of_a_point_are_tied) {
    const StitchPoint on_edge{.particles = {in_two(0, 1), in_two(0, 2), in_two(4, 4)}, .shares = {0.25f, 0.75f, 0}};
    const StitchPoint next_edge{.particles = {in_two(0, 2), in_two(0, 3), 0}, .shares = {0.5f, 0.5f, 0}};
    const Seams made =
        seams(std::vector<SeamTie>{{stitched_at(in_one(4, 1)), on_edge}, {stitched_at(in_one(4, 2)), next_edge}}, 0.1f);
    EXPECT_EQ(made.distance(in_one(4, 1), in_two(0, 1)), 0);
    EXPECT_EQ(made.distance(in_one(4, 1), in_two(0, 2)), 0);
    EXPECT_EQ(made.distance(in_one(4, 2), in_two(0, 3)), 0);
    EXPECT_EQ(made.distance(in_one(4, 1), in_two(4, 4)), Seams::far) << "it has no share";
    EXPECT_EQ(made.distance(in_one(4, 1), in_two(0, 3)), Seams::far) << "of the next stitch";
    EXPECT_EQ(made.distance(in_two(0, 1), in_two(0, 2)), Seams::far) << "of the same point";
}

TEST(Seams, wide_gaps_and_cloths_without_contact_are_none) {
    EXPECT_FALSE(seams(edge_to_edge(0.009f), 0.01f).empty());
    EXPECT_TRUE(seams(edge_to_edge(0.011f), 0.01f).empty());
    EXPECT_EQ(seams(edge_to_edge(0.011f), 0.01f).distance(in_one(4, 0), in_two(0, 0)), Seams::far);
    const std::vector<SeamedCloth> first{{seamed_one.data(), base_one, seam_side * seam_side, 0.01f}};
    EXPECT_TRUE(Seams(edge_to_edge(), first).empty());
    EXPECT_TRUE(Seams({}, first).empty());
    EXPECT_TRUE(Seams(edge_to_edge(), {}).empty());
}

}  // namespace
}  // namespace weft
