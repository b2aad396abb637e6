#include "vulkan/primitives/scan.h"

#include "vulkan/primitives/device.test.h"

#include <numeric>
#include <random>

namespace weft::vulkan {
namespace {

class Scan : public DeviceTest {
  protected:
    void expect_sums(const std::vector<std::uint32_t>& numbers) {
        std::vector<std::uint32_t> sums(numbers.size());
        std::exclusive_scan(numbers.begin(), numbers.end(), sums.begin(), 0u);
        const auto before = exclusive_scan(device(), programs(), numbers);
        ASSERT_TRUE(before.ok()) << before.error().message();
        EXPECT_TRUE(*before == sums) << numbers.size() << " numbers";
        std::inclusive_scan(numbers.begin(), numbers.end(), sums.begin());
        const auto with = inclusive_scan(device(), programs(), numbers);
        ASSERT_TRUE(with.ok()) << with.error().message();
        EXPECT_TRUE(*with == sums) << numbers.size() << " numbers, inclusive";
    }
};

std::vector<std::uint32_t> random_numbers(std::size_t count) {
    std::mt19937 random(static_cast<std::uint32_t>(count));
    std::vector<std::uint32_t> numbers(count);
    for (std::uint32_t& number : numbers) number = static_cast<std::uint32_t>(random());
    return numbers;
}

TEST_F(Scan, gives_the_sums_of_the_standard_library) {
    constexpr std::size_t tile = WEFT_TILE;
    for (const std::size_t count :
         {std::size_t{0}, std::size_t{1}, std::size_t{2}, std::size_t{WEFT_EACH}, std::size_t{WEFT_GROUP} - 1,
          std::size_t{WEFT_GROUP}, std::size_t{WEFT_GROUP} + 1, tile - 1, tile, tile + 1, 2 * tile, 7 * tile + 13})
        expect_sums(random_numbers(count));
}

TEST_F(Scan, of_equal_numbers) {
    for (const std::uint32_t number : {0u, 1u, 0xffffffffu}) expect_sums(std::vector<std::uint32_t>(10000, number));
}

// From this size on, the sums of tiles do not fit into one tile.
TEST_F(Scan, of_so_many_that_it_takes_three_levels) {
    constexpr std::size_t square = std::size_t{WEFT_TILE} * WEFT_TILE;
    for (const std::size_t count : {square - 1, square, square + 1}) expect_sums(random_numbers(count));
}

TEST_F(Scan, goes_on_along_y_where_x_is_full) {
    open(3);
    for (const std::size_t groups : {3, 4, 6, 7, 11}) expect_sums(random_numbers(groups * WEFT_TILE - 5));
}

}  // namespace
}  // namespace weft::vulkan
