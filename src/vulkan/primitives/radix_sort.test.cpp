#include "vulkan/primitives/radix_sort.h"

#include "vulkan/primitives/device.test.h"

#include <algorithm>
#include <random>
#include <tuple>

namespace weft::vulkan {
namespace {

using Keys = std::vector<KeyedValue>;

constexpr std::size_t tile = WEFT_TILE;

class RadixSort : public DeviceTest {
  protected:
    void expect_sorted(const Keys& keys, std::uint32_t bits) {
        const auto sorted = sort_keys(device(), programs(), keys, bits);
        ASSERT_TRUE(sorted.ok()) << sorted.error().message();
        Keys expected = keys;
        std::stable_sort(expected.begin(), expected.end(), [](const KeyedValue& a, const KeyedValue& b) {
            return std::tie(a.high, a.low) < std::tie(b.high, b.low);
        });
        EXPECT_TRUE(*sorted == expected) << keys.size() << " keys of " << bits << " bits";
    }
};

/// Values count up, so that only a stable sort equals the stable sort of the standard library.
Keys random_keys(std::size_t count, std::uint32_t bits) {
    std::mt19937 random(static_cast<std::uint32_t>(count + bits));
    const std::uint32_t mask = bits < 32 ? (1u << bits) - 1 : ~0u;
    Keys keys(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        keys[i].high = static_cast<std::uint32_t>(random()) & mask;
        keys[i].low = static_cast<std::uint32_t>(random()) & mask;
        keys[i].value = i;
    }
    return keys;
}

TEST_F(RadixSort, sorts_around_the_boundaries_of_tiles) {
    for (const std::size_t count :
         {std::size_t{0}, std::size_t{1}, std::size_t{2}, std::size_t{WEFT_GROUP} - 1, std::size_t{WEFT_GROUP},
          std::size_t{WEFT_GROUP} + 1, tile - 1, tile, tile + 1, 3 * tile - 1, 3 * tile, 3 * tile + 1})
        expect_sorted(random_keys(count, 32), 32);
}

// With few bits, many keys are equal. Digits are in the low word, across both words and in the high word.
TEST_F(RadixSort, takes_the_bits_that_there_are) {
    for (std::uint32_t bits = 0; bits <= 32; ++bits) expect_sorted(random_keys(5000, bits), bits);
}

TEST_F(RadixSort, keeps_what_is_sorted_and_turns_what_is_reversed) {
    Keys keys = random_keys(20000, 20);
    std::ranges::sort(keys, {}, [](const KeyedValue& key) { return std::pair(key.high, key.low); });
    expect_sorted(keys, 20);
    std::ranges::reverse(keys);
    expect_sorted(keys, 20);
}

TEST_F(RadixSort, keeps_the_order_of_equal_keys) {
    Keys keys = random_keys(3 * tile + 100, 0);
    expect_sorted(keys, 32);
    for (KeyedValue& key : keys) key.high = key.low = 0xffffffffu;
    expect_sorted(keys, 32);
    for (std::size_t i = 0; i < keys.size(); ++i) keys[i].low = i % 7 ? 12345 : 54321;
    expect_sorted(keys, 32);
}

TEST_F(RadixSort, goes_on_along_y_where_x_is_full) {
    open(3);
    for (const std::size_t tiles : {3, 4, 6, 7, 11}) expect_sorted(random_keys(tiles * tile - 5, 18), 18);
}

TEST_F(RadixSort, gives_the_same_every_time) {
    const Keys keys = random_keys(100000, 9);
    const auto first = sort_keys(device(), programs(), keys, 9), second = sort_keys(device(), programs(), keys, 9);
    ASSERT_TRUE(first.ok() && second.ok());
    EXPECT_TRUE(*first == *second);
}

TEST_F(RadixSort, knows_how_many_bits_numbers_need) {
    EXPECT_EQ(bits_below(0), 0u);
    EXPECT_EQ(bits_below(1), 0u);
    EXPECT_EQ(bits_below(2), 1u);
    EXPECT_EQ(bits_below(256), 8u);
    EXPECT_EQ(bits_below(257), 9u);
    EXPECT_EQ(bits_below(0xffffffffu), 32u);
}

// The number of sides of a mesh of 3.3 million triangles, and the number of bits that its vertices need.
// Labels: slow no-asan long
TEST_F(RadixSort, sorts_ten_million_keys) {
    expect_sorted(random_keys(10000000, 21), 21);
}

}  // namespace
}  // namespace weft::vulkan
