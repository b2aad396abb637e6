#include "solver/state/address_space.h"

#include <gtest/gtest.h>

#include <map>
#include <random>

namespace weft {
namespace {

TEST(AddressSpace, gives_ranges_one_after_another) {
    AddressSpace space;
    EXPECT_EQ(space.take(112), AddressSpace::reserved);
    EXPECT_EQ(space.take(160), AddressSpace::reserved + 112);
    EXPECT_EQ(space.end(), AddressSpace::reserved + 112 + 160);
}

TEST(AddressSpace, takes_the_first_range_that_is_free_again) {
    AddressSpace space;
    const auto a = space.take(160), b = space.take(112);
    space.take(112);
    space.give_back(a, 160);
    space.give_back(b, 112);
    EXPECT_EQ(space.take(272), a) << "neighbors are one free range";
}

TEST(AddressSpace, shrinks_when_the_last_ranges_are_given_back) {
    AddressSpace space;
    const auto a = space.take(112), b = space.take(112);
    space.give_back(a, 112);
    space.give_back(b, 112);
    EXPECT_EQ(space.end(), AddressSpace::reserved);
}

TEST(AddressSpace, never_gives_a_particle_twice) {
    AddressSpace space;
    std::map<std::uint32_t, std::uint32_t> taken;  // begin -> count
    std::mt19937 random(7);
    for (int i = 0; i < 5000; ++i) {
        if (taken.empty() || random() % 5 < 3) {
            const std::uint32_t count = 16 * (1 + random() % 40), begin = space.take(count);
            const auto after = taken.lower_bound(begin);
            ASSERT_TRUE(after == taken.end() || begin + count <= after->first);
            ASSERT_TRUE(after == taken.begin() || std::prev(after)->first + std::prev(after)->second <= begin);
            ASSERT_LE(begin + count, space.end());
            taken[begin] = count;
        } else {
            const auto one = std::next(taken.begin(), static_cast<std::ptrdiff_t>(random() % taken.size()));
            space.give_back(one->first, one->second);
            taken.erase(one);
        }
    }
}

}  // namespace
}  // namespace weft
