#include "physics/testing.h"

namespace weft {
namespace {

using namespace testing_kernels;

TEST(PinLoad, adds_mass_that_grows_with_the_square_of_the_substep) {
    EXPECT_EQ(reference::steady_part(0, 0, make_step(0.01)), 1);
    EXPECT_NEAR(reference::steady_part(5000, 0, make_step(0.01)), 1 / 1.5, 1e-12);
    EXPECT_NEAR(reference::steady_part(5000, 0, make_step(0.001)), 1 / 1.005, 1e-12);
}

TEST(PinLoad, is_at_most_256_times_the_mass) {
    for (const double much : {1e9, 1e30})
        EXPECT_NEAR(reference::steady_part(much, 0, make_step(0.01)), 1.0 / 257, 1e-12);
}

TEST(PinLoad, ends_when_the_pin_is_let_go) {
    EXPECT_EQ(reference::steady_part(5000, 0.1, make_step(0.01)), 1);
}

}  // namespace
}  // namespace weft
