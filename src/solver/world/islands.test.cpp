#include "solver/world/islands.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

namespace weft {
namespace {

using testing::ElementsAre;
using Ties = std::vector<std::array<std::uint32_t, 2>>;

TEST(Islands, without_ties_are_the_numbers_themselves) {
    EXPECT_THAT(group_islands(3, {}), ElementsAre(ElementsAre(0), ElementsAre(1), ElementsAre(2)));
}

TEST(Islands, hold_what_is_tied_through_others) {
    EXPECT_THAT(group_islands(6, Ties{{5, 1}, {3, 5}, {2, 2}}),
                ElementsAre(ElementsAre(0), ElementsAre(1, 3, 5), ElementsAre(2), ElementsAre(4)));
}

TEST(Islands, do_not_depend_on_the_order_of_ties) {
    EXPECT_EQ(group_islands(8, Ties{{7, 6}, {0, 3}, {6, 3}}), group_islands(8, Ties{{3, 6}, {6, 7}, {3, 0}}));
}

TEST(Links, of_one_color_share_no_particle) {
    std::vector<PlacedStitch> stitches;
    for (std::uint32_t i = 0; i < 40; ++i)
        stitches.push_back({.from = {{200 + i, 201 + i, 300}, {0.5f, 0.5f, 0}}, .to = {{400 + i, 0, 0}, {1, 0, 0}}});
    const LinkTables tables = make_links(stitches, 0);
    const ConstraintTable& table = tables[static_cast<std::uint32_t>(ConstraintKind::stitch)];
    EXPECT_EQ(table.rows, 40u);
    std::uint32_t real = 0;
    for (const Batch& batch : table.batches) {
        if (batch.serial) continue;
        std::set<std::uint32_t> seen;
        for (std::uint32_t row = batch.begin; row < batch.padded_end(); ++row) {
            real += table.is_real(row);
            for (std::uint32_t slot = 0; slot < table.arity; ++slot) {
                const std::uint32_t p = table.particles[slot * table.stride + row];
                const bool lone = row % lane_padding == 0;  // rows share dummies; lanes of a packet do not
                if (lone) std::erase_if(seen, [&](std::uint32_t q) { return table.is_dummy(q); });
                EXPECT_TRUE(seen.insert(p).second) << p;
            }
        }
    }
    EXPECT_EQ(real + table.overflow(), 40u);
}

TEST(Links, of_points_to_themselves_are_none) {
    const LinkTables tables = make_links(std::vector<PlacedStitch>{{.from = {{120, 0, 0}}, .to = {{120, 0, 0}}}}, 0);
    for (const ConstraintTable& table : tables) EXPECT_TRUE(table.batches.empty());
}

}  // namespace
}  // namespace weft
