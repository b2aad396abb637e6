#include "base/flush_subnormals.h"

#include <gtest/gtest.h>

namespace weft {
namespace {

TEST(FlushSubnormals, while_it_lives_and_no_longer) {
    volatile float small = 1.2e-38f, tenth = 0.1f;
    {
        const FlushSubnormals flush;
#if defined(__SSE2__) || defined(__aarch64__)
        EXPECT_EQ(small * tenth, 0.0f);
#endif
        EXPECT_EQ(small * 10.0f, 1.2e-37f) << "what is normal stays as it is";
    }
    EXPECT_GT(small * tenth, 0.0f);
}

}  // namespace
}  // namespace weft
