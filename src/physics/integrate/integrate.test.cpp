#include "physics/testing.h"

namespace weft {
namespace {

using scalar::Motion;
using scalar::Step;

struct Falling {
    scalar::vec3 x, start;
    Motion m{scalar::vec3(0.0f), scalar::vec3(0.0f), scalar::vec3(0.0f)};

    void substep(float h, float g) {
        const Step step = scalar::step_without_limits(h, 1 / h, 1 / h / h);
        start = x;
        scalar::predict(x, m, 1.0f, {0, g, 0}, 1e9f, step);
        scalar::update_velocity(m, x, start, 1.0f, 1e9f, step);
    }
};

class FreeFall : public testing::TestWithParam<int> {};

// Ten meters from the origin a substep's motion is far below the spacing of floats; without compensation the fall would
// be several percent too slow, or never start.
TEST_P(FreeFall, loses_nothing_to_rounding) {
    const int substeps = GetParam();
    const float h = static_cast<float>(1.0 / 60 / substeps);
    Falling body{.x = scalar::vec3(10.0f, 10.0f, 10.0f), .start = {}};
    const int count = 60 * substeps;
    double last = 10;
    for (int i = 0; i < count; ++i) {
        if (i == count - 60) last = static_cast<double>(body.x.y) + body.m.x_dropped.y;
        body.substep(h, -9.81f);
    }
    const double t = static_cast<double>(h) * count, g = -9.81f;
    const double expected_velocity = g * t;
    EXPECT_NEAR(body.m.v.y / expected_velocity, 1, 1e-5);
    // x₀ + ½ g t (t + h), the exact sum of the scheme.
    const double fallen = static_cast<double>(body.x.y) + body.m.x_dropped.y - 10;
    EXPECT_NEAR(fallen / (0.5 * g * t * (t + h)), 1, 1e-5);
    // The speed of its motion equals its velocity.
    const double seen = (static_cast<double>(body.x.y) + body.m.x_dropped.y - last) / (60.0 * h);
    EXPECT_NEAR(seen / (expected_velocity - g * 29.5 * h), 1, 1e-5);
}

INSTANTIATE_TEST_SUITE_P(Substeps, FreeFall, testing::Values(1, 20, 60, 252));

TEST(Integrate, a_pinned_particle_stays) {
    scalar::vec3 x(1, 2, 3);
    const scalar::vec3 start = x;
    Motion m{scalar::vec3(0.0f), scalar::vec3(0.0f), scalar::vec3(0.0f)};
    const Step step = scalar::step_without_limits(1e-3f, 1e3f, 1e6f);
    for (int i = 0; i < 100; ++i) {
        scalar::predict(x, m, 0.0f, {0, -1e6f, 0}, 1e9f, step);
        scalar::update_velocity(m, x, start, 0.0f, 1e9f, step);
    }
    EXPECT_EQ(x.y, 2);
    EXPECT_EQ(m.v.y, 0);
}

TEST(Integrate, speed_is_capped_and_says_so) {
    scalar::vec3 x(0.0f);
    Motion m{scalar::vec3(3, 0, 4), scalar::vec3(0.0f), scalar::vec3(0.0f)};
    const Step step = scalar::step_without_limits(0.1f, 10, 100);
    EXPECT_FALSE(scalar::predict(x, m, 1.0f, scalar::vec3(0.0f), 5.1f, step));
    EXPECT_TRUE(scalar::predict(x, m, 1.0f, scalar::vec3(0.0f), 2.5f, step));
    EXPECT_NEAR(m.v.x, 1.5f, 1e-6f);
    EXPECT_NEAR(m.v.z, 2.0f, 1e-6f);
    EXPECT_TRUE(scalar::update_velocity(m, scalar::vec3(1e6f, 0, 0), scalar::vec3(0.0f), 1.0f, 2.5f, step));
    EXPECT_LE(std::sqrt(scalar::dot(m.v, m.v)), 2.5001f);
}

// Velocity from positions with compensation is Verlet's x' = 2x - x_before + h² a; both forms give the same path.
TEST(Integrate, agrees_with_verlet) {
    const double h = 1e-3, g = -9.81;
    reference::vec3 x(0, 1, 0), start(0.0);
    reference::Motion m{reference::vec3(1, 0, 0), reference::vec3(0.0), reference::vec3(0.0)};
    double verlet_before = 1, verlet = 1;
    const reference::Step step = reference::step_without_limits(h, 1 / h, 1 / (h * h));
    for (int i = 0; i < 1000; ++i) {
        start = x;
        reference::predict(x, m, 1.0, {0, g, 0}, 1e9, step);
        const double next = 2 * verlet - verlet_before + h * h * g;
        verlet_before = verlet;
        verlet = next;
        if (i % 10 == 0) {  // a floor that takes half the motion, in both
            x.y = 0.5 * (x.y + start.y);
            verlet = 0.5 * (verlet + verlet_before);
        }
        reference::update_velocity(m, x, start, 1.0, 1e9, step);
    }
    EXPECT_NEAR(x.y + m.x_dropped.y, verlet, 1e-10);
}

TEST(Angle, is_atan2) {
    for (double a = -3.1415; a < 3.1416; a += 0.001) {
        for (const double size : {1e-12, 1.0, 1e12}) {
            const float y = static_cast<float>(size * std::sin(a)), x = static_cast<float>(size * std::cos(a));
            EXPECT_NEAR(scalar::angle_of(y, x), std::atan2(double{y}, double{x}), 3.1e-7);
        }
    }
    EXPECT_EQ(scalar::angle_of(0.0f, 0.0f), 0);
    EXPECT_EQ(scalar::angle_of(0.0f, 1.0f), 0);
    EXPECT_NEAR(scalar::angle_of(0.0f, -1.0f), 3.14159265f, 1e-6f);
    EXPECT_NEAR(scalar::angle_of(-1.0f, 0.0f), -1.57079633f, 1e-6f);
}

}  // namespace
}  // namespace weft
