#include "physics/testing.h"

namespace weft {
namespace {

using namespace testing_kernels;
using reference::Flow;
using reference::WindLife;

constexpr double gust = 0.3, turbulence = 0.4;

WindLife lively(double turns = 3.2) {
    return {gust, turns, 0.25, 0, turbulence, 2, 17.3, vec3(5, 6, 7)};
}

TEST(Wind, without_life_is_its_flow) {
    const WindLife still{0, 1.3, 1, 0, 0, 1, 0.5, vec3(0.0)};
    const vec3 u = reference::live_wind({vec3(1, 2, 3), 4, 5}, 6, still);
    EXPECT_EQ(norm(u - vec3(1, 2, 3)), 0);
}

TEST(Wind, blows_its_own_way_between_its_bounds) {
    Random random(1);
    const vec3 u0(3, -1, 2);
    double least = 9, most = 0;
    for (int i = 0; i < 20000; ++i) {
        const Flow flow{u0, random.number(-50, 50), random.number(-50, 50)};
        WindLife life = lively(random.number(0, 16));
        life.scattered = i % 2;
        const vec3 u = reference::live_wind(flow, i, life);
        EXPECT_LT(norm(reference::cross(u, u0)), 1e-12);
        const double part = norm(u) / norm(u0);
        least = std::min(least, part), most = std::max(most, part);
    }
    EXPECT_GE(least, 1 - gust - turbulence);
    EXPECT_LE(most, 1 + gust + turbulence);
    EXPECT_LT(least, 1 - gust);
    EXPECT_GT(most, 1 + gust);
}

TEST(Wind, is_the_same_along_itself_and_smooth_across) {
    const reference::WindNumbers numbers{vec3(0, 0, 4), vec3(1, 0, 0), vec3(0, 1, 0), 0, 0, 0};
    Random random(2);
    for (int i = 0; i < 500; ++i) {
        const vec3 p = random.vector(5);
        const auto at = [&](vec3 x) {
            return reference::live_wind(reference::flow_directional(x, numbers), 0, lively());
        };
        EXPECT_LT(norm(at(p) - at(p + vec3(0, 0, random.number(-9, 9)))), 1e-12);
        EXPECT_LT(norm(at(p) - at(p + random.vector(1e-4))), 0.02);
    }
}

TEST(Wind, swells_with_its_period) {
    const Flow flow{vec3(1, 0, 0), 0.3, -0.4};
    for (const double scattered : {0.0, 1.0}) {
        for (double number = 0; number < 40; ++number) {
            WindLife a = lively(0.37), b = lively(16.37);  // where the turns wrap around
            a.scattered = b.scattered = scattered;
            EXPECT_LT(norm(reference::live_wind(flow, number, a) - reference::live_wind(flow, number, b)), 1e-9);
        }
    }
}

TEST(Wind, scattered_gives_every_triangle_a_gust_of_its_own) {
    const Flow flow{vec3(1, 0, 0), 0, 0};
    WindLife life = lively();
    life.scattered = 1, life.turbulence = 0;
    double alike = 0;
    const double first = reference::live_wind(flow, 0, life).x;
    for (double number = 1; number < 1000; ++number) {
        alike += std::abs(reference::live_wind(flow, number, life).x - first) < 0.01;
    }
    EXPECT_LT(alike, 100);
    // Up to 2^24 triangles, each the same at every precision.
    for (const double number : {1e5, 1e6, 16777215.0}) {
        const scalar::WindLife f{0.3f, 3.25f, 0.25f, 1, 0, 2, 17.25f, scalar::vec3(5, 6, 7)};
        life = {0.3, 3.25, 0.25, 1, 0, 2, 17.25, vec3(5, 6, 7)};
        const float single = scalar::live_wind({scalar::vec3(1, 0, 0), 0, 0}, static_cast<float>(number), f).x;
        EXPECT_NEAR(single, reference::live_wind(flow, number, life).x, 1e-4) << number;
    }
}

}  // namespace
}  // namespace weft
