#include "physics/testing.h"

namespace weft {
namespace {

TEST(ExpOfMinus, is_the_exponential_function) {
    EXPECT_EQ(scalar::exp_of_minus(0.0f), 1.0f);
    for (double x = 0; x < 79.9; x += 1.7e-3) {
        const double expected = std::exp(-x);
        EXPECT_NEAR(reference::exp_of_minus(x) / expected, 1, 2e-8) << x;
        const float single = static_cast<float>(x);
        EXPECT_NEAR(scalar::exp_of_minus(single) / std::exp(-static_cast<double>(single)), 1, 3e-7) << x;
    }
}

TEST(ExpOfMinus, ends_at_zero) {
    for (const float x : {80.0f, 1e3f, 3e38f, std::numeric_limits<float>::infinity()})
        EXPECT_EQ(scalar::exp_of_minus(x), 0.0f) << x;
    EXPECT_GT(scalar::exp_of_minus(79.9f), 0.0f);
}

}  // namespace
}  // namespace weft
