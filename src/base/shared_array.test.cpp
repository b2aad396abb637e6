#include "base/shared_array.h"

#include "base/aligned.h"

#include <gtest/gtest.h>

#include <numeric>
#include <vector>

namespace weft {
namespace {

TEST(SharedArray, takes_the_elements_of_a_vector_without_copying_them) {
    AlignedVector<int> numbers(100);
    std::iota(numbers.begin(), numbers.end(), 0);
    const int* elements = numbers.data();
    const SharedArray<int> array = std::move(numbers);
    EXPECT_EQ(array.data(), elements);
    ASSERT_EQ(array.size(), 100u);
    EXPECT_EQ(std::accumulate(array.begin(), array.end(), 0), 4950);
    EXPECT_EQ(array.front() + array.back() + array[7], 106);
    EXPECT_EQ(std::span<const int>(array).size(), 100u);
}

TEST(SharedArray, shares_its_elements_with_its_copies) {
    SharedArray<int> copy;
    EXPECT_TRUE(copy.empty());
    {
        const SharedArray<int> array = std::vector<int>{1, 2, 3};
        copy = array;
        EXPECT_TRUE(copy.shares(array));
    }
    EXPECT_EQ(copy, (SharedArray<int>(std::vector<int>{1, 2, 3})));
    EXPECT_FALSE(copy.shares(std::vector<int>{1, 2, 3}));
    EXPECT_NE(copy, (SharedArray<int>(std::vector<int>{1, 2})));
    EXPECT_NE(copy, (SharedArray<int>(std::vector<int>{1, 2, 4})));
}

TEST(SharedArray, keeps_what_a_copy_has_when_it_is_assigned) {
    SharedArray<int> array = std::vector<int>{1, 2, 3};
    const SharedArray<int> before = array;
    array = std::vector<int>{4};
    EXPECT_EQ(before.size(), 3u);
    EXPECT_EQ(array.size(), 1u);
    array = {};
    EXPECT_TRUE(array.empty());
}

}  // namespace
}  // namespace weft
