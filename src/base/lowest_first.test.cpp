#include "base/lowest_first.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace weft {
namespace {

TEST(LowestFirst, gives_the_lowest_key_and_of_equal_ones_the_lowest_item) {
    std::mt19937 random(7);
    constexpr std::uint32_t items = 300;
    LowestFirst queue(items);
    std::set<std::pair<double, std::uint32_t>> expected;
    std::vector<double> key(items, -1);  // of what is in the queue
    for (int round = 0; round < 20000; ++round) {
        if (random() % 3 == 0 && !queue.empty()) {
            const LowestFirst::Entry lowest = queue.pop();
            ASSERT_EQ(std::pair(lowest.key, lowest.item), *expected.begin());
            expected.erase(expected.begin());
            key[lowest.item] = -1;
            continue;
        }
        const std::uint32_t item = random() % items;
        const double wanted = random() % 50;
        if (key[item] >= 0 && wanted >= key[item]) continue;
        if (key[item] >= 0) expected.erase({key[item], item});
        key[item] = wanted;
        expected.insert({wanted, item});
        queue.put(item, wanted);
    }
    for (const auto& [wanted, item] : expected) EXPECT_EQ(queue.pop().item, item);
    EXPECT_TRUE(queue.empty());
}

}  // namespace
}  // namespace weft
