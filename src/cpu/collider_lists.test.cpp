#include "cpu/collider_lists.h"

#include "cpu/bodies.h"

#include <gtest/gtest.h>

namespace weft::cpu {
namespace {

constexpr std::uint32_t tile_particles = 3 * lane_padding;  // three tiles, 10 m apart

struct Tiles {
    Tiles() {
        for (int i = 0; i < 4; ++i)
            colliders.push_back(make_collider(
                {.shape = SphereDesc{0.5f}, .transform = {.position = {10 * static_cast<float>(i), 0, 0}}}));
        places.begin_frame(colliders, 0, 0.1, 10);
        for (std::uint32_t p = 0; p < tile_particles; ++p)
            position[p] =
                start[p] = {10 * static_cast<float>(p / lane_padding), 0.01f * static_cast<float>(p % 16), 0, 1};
    }

    ParticleView view() { return {&position[0].x, &start[0].x, nullptr, nullptr}; }
    void move_tile(std::uint32_t tile, Vec3 by) {
        for (std::uint32_t p = tile * lane_padding; p < (tile + 1) * lane_padding; ++p) {
            Vec4& x = position[p];
            x = {x.x + by.x, x.y + by.y, x.z + by.z, x.w};
        }
    }
    void cover(float longest = 0) {
        part.cover(scalar_passes(), view(), places, Bodies(),
                   {.fall = {}, .substeps = 1, .margin = 0.1f, .widest = 0.1f, .longest = longest});
    }
    std::vector<std::uint32_t> near(std::uint32_t tile) const {
        std::vector<std::uint32_t> found;
        for (const ColliderRun& run : part.runs()) {
            if (run.begin > tile * lane_padding || run.end <= tile * lane_padding) continue;
            for (const NearCollider& near : part.near(run)) found.push_back(near.collider);
        }
        return found;
    }

    std::vector<Collider> colliders;
    ColliderPlaces places;
    AlignedVector<Vec4> position = AlignedVector<Vec4>(tile_particles), start = position;
    ColliderPart part;
};

using Colliders = std::vector<std::uint32_t>;

TEST(ColliderLists, list_what_is_near_each_tile) {
    Tiles tiles;
    tiles.part.begin_frame({0, tile_particles});
    tiles.cover();
    for (std::uint32_t tile = 0; tile < 3; ++tile) EXPECT_EQ(tiles.near(tile), Colliders{tile});
}

TEST(ColliderLists, reach_as_far_as_edges_are_long) {
    Tiles tiles;
    tiles.part.begin_frame({0, tile_particles});
    tiles.cover(0.1f);
    tiles.cover(7);  // finds what edges of 10.5 m may touch
    EXPECT_EQ(tiles.near(1), (Colliders{0, 1, 2}));
    tiles.part.begin_frame({0, tile_particles});
    tiles.cover(7);
    EXPECT_EQ(tiles.near(2), (Colliders{1, 2, 3}));
    tiles.part.begin_frame({0, tile_particles});
    tiles.cover(0.1f);
    EXPECT_EQ(tiles.near(1), Colliders{1});
}

TEST(ColliderLists, a_tile_that_leaves_its_box_keeps_its_colliders_and_their_sums) {
    Tiles tiles;
    tiles.part.reserve(3, 4, true, true);
    tiles.part.begin_frame({0, tile_particles});
    tiles.cover();
    for (const ColliderRun& run : tiles.part.runs()) {
        for (const NearCollider& near : tiles.part.near(run)) {
            for (std::uint32_t p = run.begin; p < run.end; ++p) {
                tiles.part.sums(near)[4 * (p - run.begin)] = static_cast<float>(p);
                tiles.part.turned(near)[4 * (p - run.begin)] = static_cast<float>(100 + p);
            }
        }
    }
    tiles.move_tile(2, {10, 0, 0});
    tiles.cover();
    EXPECT_EQ(tiles.near(1), Colliders{1});
    EXPECT_EQ(tiles.near(2), (Colliders{2, 3}));
    for (const ColliderRun& run : tiles.part.runs()) {
        for (const NearCollider& near : tiles.part.near(run)) {
            for (std::uint32_t p = run.begin; p < run.end; ++p) {
                const bool is_new = near.collider == 3;
                EXPECT_EQ(tiles.part.sums(near)[4 * (p - run.begin)], is_new ? 0 : static_cast<float>(p));
                EXPECT_EQ(tiles.part.moved(near)[4 * (p - run.begin)], 0);
                EXPECT_EQ(tiles.part.turned(near)[4 * (p - run.begin)], is_new ? 0 : static_cast<float>(100 + p));
            }
        }
    }
    tiles.part.begin_frame({0, tile_particles});
    tiles.start = tiles.position;
    tiles.cover();
    EXPECT_EQ(tiles.near(2), Colliders{3}) << "the next frame lists anew";
}

TEST(ColliderLists, neighbors_with_the_same_colliders_are_one_run) {
    Tiles tiles;
    tiles.move_tile(1, {-10, 0, 0});
    tiles.start = tiles.position;
    tiles.part.begin_frame({0, tile_particles});
    tiles.cover();
    ASSERT_EQ(tiles.part.runs().size(), 2u);
    EXPECT_EQ(tiles.part.runs()[0].end, 2u * lane_padding);
}

TEST(ColliderLists, leave_out_particles_without_a_mass) {
    Tiles tiles;
    for (Vec4& x : tiles.position) x.w = 0;
    tiles.part.begin_frame({0, tile_particles});
    tiles.cover();
    EXPECT_TRUE(tiles.part.runs().empty());
}

}  // namespace
}  // namespace weft::cpu
