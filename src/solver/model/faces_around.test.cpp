#include "solver/model/faces_around.h"

#include "mesh/procedural.h"
#include "solver/model/constraint_table.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace weft {
namespace {

TEST(FacesAround, holds_every_triangle_once_and_in_order) {
    const TriangleMesh mesh = make_grid({1, 1}, {9, 7}, GridDiagonal::alternating);
    const auto topology = build_topology(mesh, {.reorder = false});
    constexpr std::uint32_t nothing = 12345;
    const FacesAround around = lay_out_around(topology->particle_triangles, nothing);
    ASSERT_EQ(around.begin.size(), padded(topology->particle_count) / lane_padding + 1);
    EXPECT_EQ(around.triangles.size(), std::size_t{around.begin.back()} * lane_padding);
    for (std::uint32_t p = 0; p < topology->particle_count; ++p) {
        const std::uint32_t packet = p / lane_padding;
        ASSERT_TRUE(around.abreast(packet));
        const auto expected = topology->particle_triangles[p];
        for (std::uint32_t k = around.begin[packet]; k < around.begin[packet + 1]; ++k) {
            const std::uint32_t got = around.triangles[k * lane_padding + p % lane_padding];
            const std::uint32_t i = k - around.begin[packet];
            EXPECT_EQ(got, i < expected.size() ? expected[i] : nothing);
        }
    }
}

TEST(FacesAround, a_hub_is_left_to_itself) {
    Adjacency lists{.offsets = {0}, .items = {}};
    for (std::uint32_t p = 0; p < 40; ++p) {
        for (std::uint32_t k = 0; k < (p == 20 ? 1000u : 2u); ++k) lists.items.push_back(k);
        lists.offsets.push_back(static_cast<std::uint32_t>(lists.items.size()));
    }
    const FacesAround around = lay_out_around(lists, 1000);
    EXPECT_TRUE(around.abreast(0));
    EXPECT_FALSE(around.abreast(1));
    EXPECT_TRUE(around.abreast(2));
    EXPECT_EQ(around.triangles.size(), 4 * lane_padding);
    for (std::uint32_t p = 16; p < 32; ++p) {
        const std::uint32_t at = around.own[1] + p % lane_padding;
        const std::vector<std::uint32_t> list(around.items.begin() + around.offsets[at],
                                              around.items.begin() + around.offsets[at + 1]);
        EXPECT_TRUE(std::ranges::equal(list, lists[p])) << p;
    }
}

}  // namespace
}  // namespace weft
