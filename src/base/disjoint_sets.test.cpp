#include "base/disjoint_sets.h"

#include <gtest/gtest.h>

namespace weft {
namespace {

TEST(DisjointSets, sets_that_merge_share_their_smallest_number) {
    DisjointSets sets(7);
    sets.merge(5, 3);
    sets.merge(6, 5);
    sets.merge(1, 1);
    sets.merge(3, 2);
    for (const std::uint32_t i : {2u, 3u, 5u, 6u}) EXPECT_EQ(sets.first_of(i), 2u) << i;
    for (const std::uint32_t i : {0u, 1u, 4u}) EXPECT_EQ(sets.first_of(i), i);
}

}  // namespace
}  // namespace weft
