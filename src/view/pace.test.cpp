#include "view/pace.h"

#include <gtest/gtest.h>

namespace weft {
namespace {

TEST(Pace, keeps_step_with_the_clock) {
    Pace pace(1.0 / 60);
    unsigned steps = 0;
    for (int i = 0; i < 144; ++i) steps += pace.due(1.0 / 144);
    EXPECT_EQ(steps, 60u);
    for (int i = 0; i < 30; ++i) EXPECT_EQ(pace.due(1.0 / 30), 2u);
    for (int i = 0; i < 1000; ++i) EXPECT_EQ(pace.due(1.0 / 60), 1u) << "one for each picture, never none and then two";
}

TEST(Pace, never_runs_after_the_clock) {
    Pace pace(1.0 / 60, 3);
    EXPECT_EQ(pace.due(10), 3u);
    EXPECT_EQ(pace.due(0), 0u) << "what was missed is not made up for";
    EXPECT_EQ(pace.due(1.0 / 60), 1u);
}

TEST(Pace, a_clock_that_stands_still_or_goes_back_is_no_step) {
    Pace pace(0.01);
    EXPECT_EQ(pace.due(0), 0u);
    EXPECT_EQ(pace.due(-5), 0u);
    EXPECT_EQ(pace.due(0.01), 1u);
}

}  // namespace
}  // namespace weft
