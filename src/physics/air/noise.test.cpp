#include "physics/testing.h"

#include <numbers>

namespace weft {
namespace {

using namespace testing_kernels;

TEST(SinTurns, is_the_sine) {
    for (double x = -3; x < 3; x += 1e-3) {
        EXPECT_NEAR(reference::sin_turns(x), std::sin(2 * std::numbers::pi * x), 1e-7) << x;
        EXPECT_NEAR(scalar::sin_turns(static_cast<float>(x)), std::sin(2 * std::numbers::pi * x), 3e-6) << x;
    }
    EXPECT_EQ(scalar::sin_turns(0.25f), scalar::sin_turns(16.25f));
}

TEST(Noise, of_single_and_double_precision_agree_so_that_every_corner_has_the_same_gradient_everywhere) {
    Random random(1);
    for (int i = 0; i < 3000; ++i) {
        const vec3 p = random.vector(i % 2 ? 10 : 280);
        const scalar::vec3 q(static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z));
        EXPECT_NEAR(reference::perlin({q.x, q.y, q.z}), scalar::perlin(q), 1e-4);
    }
}

TEST(Noise, stays_within_its_bounds_has_no_bias_and_is_not_flat) {
    Random random(2);
    double sum = 0, sum2 = 0, low = 0, high = 0;
    constexpr int n = 100000;
    for (int i = 0; i < n; ++i) {
        const double x = reference::perlin(random.vector(140));
        sum += x, sum2 += x * x, low = std::min(low, x), high = std::max(high, x);
    }
    EXPECT_NEAR(sum / n, 0, 5e-3);
    EXPECT_GT(sum2 / n, 0.04);
    EXPECT_GE(low, -1);
    EXPECT_LE(high, 1);
    EXPECT_LT(low, -0.6);
    EXPECT_GT(high, 0.6);
}

TEST(Noise, is_smooth_and_zero_at_the_corners) {
    Random random(3);
    for (int i = 0; i < 500; ++i) {
        const vec3 p = random.vector(20), along = random.vector(1e-5);
        const double near = reference::perlin(p + along);
        EXPECT_NEAR(reference::perlin(p), near, 1e-4);
        EXPECT_NEAR(2 * near, reference::perlin(p) + reference::perlin(p + along * 2.0), 1e-7) << "no kink";
    }
    for (double x = -3; x < 3; ++x) EXPECT_EQ(reference::perlin({x, 2 * x, 5}), 0);
}

TEST(Noise, repeats_after_289_and_survives_any_number) {
    Random random(4);
    for (int i = 0; i < 100; ++i) {
        const vec3 p = random.vector(100);
        EXPECT_NEAR(reference::perlin(p), reference::perlin(p + vec3(289, -289, 578)), 1e-9);
    }
    for (const float x : {1e7f, -1e9f, 1e20f, -3e38f}) {
        const float noise = scalar::perlin({x, 0.3f, x});
        EXPECT_TRUE(std::isfinite(noise) && std::abs(noise) <= 2) << x;
    }
}

}  // namespace
}  // namespace weft
