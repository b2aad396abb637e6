#include "physics/testing.h"

namespace weft {
namespace {

using namespace testing_kernels;
using reference::CoarseLimitRow;

TEST(CoarseLimit, leaves_alone_what_is_near_enough) {
    vec3 a(0, 0, 0), b(0.3, 0.4, 0);
    double lambda = 0;
    reference::project_coarse_limit(a, b, 1, 2, lambda, {0.51, 0, 0, 0}, make_step(0.01));
    EXPECT_EQ(norm(a), 0);
    EXPECT_EQ(lambda, 0);
}

TEST(CoarseLimit, brings_back_what_is_too_far_and_keeps_momentum) {
    Random random(1);
    for (int i = 0; i < 500; ++i) {
        vec3 a = random.vector(1), b = random.vector(1);
        const vec3 a0 = a, b0 = b;
        const double wa = random.number(0, 10), wb = random.number(0.01, 10), length = 0.5 * norm(a - b);
        double lambda = 0;
        reference::project_coarse_limit(a, b, wa, wb, lambda, {length, 0, 0, 0}, make_step(0.01));
        EXPECT_NEAR(norm(a - b), length, 1e-12);
        EXPECT_LT(norm((a - a0) * wb + (b - b0) * wa), 1e-12);
        EXPECT_LT(norm(reference::cross(a - a0, a0 - b0)), 1e-12);
        EXPECT_LT(lambda, 0);
    }
}

TEST(CoarseLimit, moves_along_the_gradient) {
    Random random(2);
    for (int i = 0; i < 100; ++i) {
        vec3 points[2] = {random.vector(1), random.vector(1)};
        vec3 a = points[0], b = points[1];
        const double length = 0.7 * norm(a - b);
        double lambda = 0;
        reference::project_coarse_limit(a, b, 2, 3, lambda, {length, 0, 0, 0}, make_step(0.01));
        const vec3 gradients[2] = {(a - points[0]) * (1 / (2 * lambda)), (b - points[1]) * (1 / (3 * lambda))};
        expect_gradient(
            points, gradients, [&] { return norm(points[0] - points[1]) - length; }, 1e-8);
    }
}

TEST(CoarseLimit, pulls_beyond_its_limit_as_the_cloth_does) {
    const double h = 0.01, compliance = 0.3, limit = 0.8, k = limit / compliance;  // N/m
    reference::Step step = make_step(h);
    step.tension = 0.5;
    step.allowed = 1.1;
    vec3 a(0.0), b(2, 0, 0);
    double lambda = 0;
    for (int sweep = 0; sweep < 3; ++sweep)
        reference::project_coarse_limit(a, b, 2, 3, lambda, {limit, compliance, 0, 0}, step);
    const double over = norm(a - b) - (limit + compliance * step.tension) * step.allowed;
    EXPECT_GT(over, 0);
    EXPECT_NEAR(-lambda / (h * h), k * over, 1e-9);
}

TEST(CoarseLimit, gives_way_near_a_pin_and_less_in_long_substeps) {
    for (const double h : {0.001, 0.01, 0.1}) {
        vec3 a(0.0), b(2, 0, 0);
        double lambda = 0;
        reference::project_coarse_limit(a, b, 0, 3, lambda, {1, 0, 0.25, 400}, make_step(h));
        EXPECT_NEAR(norm(a - b), 1 + 0.25 / (1 + 400 * h * h), 1e-12);
    }
}

// If other constraints have reduced the distance meanwhile, it undoes its pull, but it does not push.
TEST(CoarseLimit, lets_go_and_never_pushes) {
    for (const double apart : {0.95, 0.2}) {
        vec3 a(0.0), b(apart, 0, 0);
        double lambda = -0.02;
        reference::project_coarse_limit(a, b, 2, 3, lambda, {1, 0, 0, 0}, make_step(0.01));
        EXPECT_NEAR(lambda, std::min(-0.02 + (1 - apart) / 5, 0.0), 1e-12);
        EXPECT_NEAR(norm(a - b), std::min(apart + 0.02 * 5, 1.0), 1e-12);
    }
}

TEST(CoarseLimit, survives_degenerate_input) {
    using namespace scalar;
    const Step step = step_without_limits(1e-3f, 1e3f, 1e6f);
    for (const float w : {0.0f, 1.0f, 1e30f}) {
        for (const float gap : {0.0f, 1e-30f, 1e-12f, 1e12f}) {
            for (const float length : {0.0f, 1e-20f, 1.0f}) {
                for (const float compliance : {0.0f, 1e-3f, 1e10f}) {
                    scalar::vec3 a(0.0f), b(gap, 0, 0);
                    float lambda = 0;
                    for (int sweep = 0; sweep < 2; ++sweep)
                        project_coarse_limit(a, b, w, 0.0f, lambda, {length, compliance, 0, 0}, step);
                    EXPECT_TRUE(std::isfinite(a.x) && std::isfinite(b.x) && std::isfinite(lambda))
                        << w << ' ' << gap << ' ' << length << ' ' << compliance;
                }
            }
        }
    }
}

}  // namespace
}  // namespace weft
