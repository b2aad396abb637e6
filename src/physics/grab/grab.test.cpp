#include "physics/testing.h"

#include <array>

namespace weft {
namespace {

using namespace testing_kernels;
using reference::GrabRow;

constexpr double h = 1e-3;

struct Corners {
    std::array<vec3, 3> x, start;
    std::array<double, 3> w;
    vec3 lambda{0.0};

    vec3 point(const GrabRow& row) const { return x[0] * row.c0 + x[1] * row.c1 + x[2] * row.c2; }
    void project(const GrabRow& row) {
        reference::project_grab(x[0], x[1], x[2], start[0], start[1], start[2], w[0], w[1], w[2], lambda, row,
                                make_step(h));
    }
};

Corners random_corners(Random& random) {
    Corners corners;
    for (std::size_t k = 0; k < 3; ++k) {
        corners.x[k] = corners.start[k] = random.vector(1);
        corners.w[k] = random.number(0.5, 3);
    }
    return corners;
}

GrabRow row_to(Random& random, vec3 target, double max_force = 1e9, double compliance = 0, double damping = 0) {
    const double a = random.number(0, 0.5), b = random.number(0, 0.5);
    return {.target = target,
            .way = vec3(0.0),
            .c0 = a,
            .c1 = b,
            .c2 = 1 - a - b,
            .max_force = max_force,
            .compliance = compliance,
            .damping = damping,
            .reach = 0.01};
}

TEST(GrabKernel, puts_the_point_on_its_target_where_it_is_rigid) {
    Random random(1);
    for (int i = 0; i < 100; ++i) {
        Corners corners = random_corners(random);
        const GrabRow row = row_to(random, random.vector(1));
        corners.project(row);
        EXPECT_LT(norm(corners.point(row) - row.target), 1e-12);
    }
}

TEST(GrabKernel, pulls_with_the_force_of_its_spring) {
    Random random(2);
    for (int i = 0; i < 100; ++i) {
        Corners corners = random_corners(random);
        const GrabRow row = row_to(random, random.vector(1), 1e9, 1e-3);
        for (int k = 0; k < 3; ++k) corners.project(row);  // later iterations change nothing
        const vec3 force = corners.lambda * (1 / (h * h));
        EXPECT_LT(norm(force - (row.target - corners.point(row)) * 1e3), 1e-6);
    }
}

TEST(GrabKernel, damps_motion_relative_to_its_target) {
    Random random(3);
    for (int i = 0; i < 100; ++i) {
        Corners corners = random_corners(random);
        GrabRow row = row_to(random, random.vector(1), 1e9, 1e-3, 0.05);
        row.way = random.vector(0.01);
        const vec3 before = corners.point(row);
        for (int k = 0; k < 3; ++k) corners.project(row);
        const vec3 slip = corners.point(row) - before - row.way;
        const vec3 expected = (row.target - corners.point(row)) * 1e3 - slip * (0.05 / 1e-3 / h);
        EXPECT_LT(norm(corners.lambda * (1 / (h * h)) - expected), 1e-6);
    }
}

TEST(GrabKernel, never_pulls_more_than_its_limit) {
    Random random(4);
    for (int i = 0; i < 100; ++i) {
        Corners corners = random_corners(random);
        const GrabRow row = row_to(random, random.vector(1e6), 20, i % 2 * 1e-3, 0.02);
        for (int k = 0; k < 4; ++k) {
            corners.project(row);
            EXPECT_NEAR(norm(corners.lambda), 20 * h * h, 1e-15);
        }
        vec3 momentum(0.0);
        for (std::size_t k = 0; k < 3; ++k)
            momentum = momentum + (corners.x[k] - corners.start[k]) * (1 / corners.w[k]);
        EXPECT_LT(norm(momentum - corners.lambda), 1e-12);
    }
}

TEST(GrabKernel, leaves_pinned_corners) {
    Random random(5);
    Corners corners = random_corners(random);
    corners.w[1] = 0;
    const GrabRow row = row_to(random, random.vector(1));
    corners.project(row);
    EXPECT_EQ(norm(corners.x[1] - corners.start[1]), 0);
    EXPECT_LT(norm(corners.point(row) - row.target), 1e-12);
    corners = random_corners(random);
    corners.w.fill(0);
    corners.project(row);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(norm(corners.x[k] - corners.start[k]), 0);
    EXPECT_EQ(norm(corners.lambda), 0);
}

TEST(GrabKernel, survives_degenerate_input) {
    const scalar::Step step = scalar::step_without_limits(1e-3f, 1e3f, 1e6f);
    for (const float w : {0.0f, 1.0f, 1e10f}) {
        for (const float max_force : {1e-30f, 1.0f, 1e6f}) {
            for (const float away : {0.0f, 1e-12f, 1e6f}) {
                for (const float compliance : {0.0f, 1e-30f, 1e6f}) {
                    const scalar::GrabRow row{scalar::vec3(away, 0, 0),
                                              scalar::vec3(away, 0, 0),
                                              0.2f,
                                              0.3f,
                                              0.5f,
                                              max_force,
                                              compliance,
                                              0.02f,
                                              1e-2f};
                    scalar::vec3 a(0.0f), b(0.0f), c(0.0f), lambda(0.0f);  // a triangle without an area
                    float held = w;
                    scalar::take_hold(a, held, w, 0.5f, scalar::vec3(0, -10, 0), row, step);
                    scalar::project_grab(a, b, c, a, b, c, held, w, 0, lambda, row, step);
                    EXPECT_TRUE(std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(b.x) && std::isfinite(held) &&
                                std::isfinite(lambda.x))
                        << w << ' ' << max_force << ' ' << away << ' ' << compliance;
                    EXPECT_EQ(c.x, 0);
                }
            }
        }
    }
}

TEST(Hand, is_moved_by_its_reach_and_does_not_fall) {
    Random random(6);
    const GrabRow row = row_to(random, vec3(0.0), 20);
    const double mass = reference::hand_mass(row, make_step(h));
    EXPECT_NEAR(20 / mass * h * h, row.reach, 1e-12);
    vec3 x(0.0);
    double w = 100;
    const vec3 gravity(0, -10, 0);
    reference::take_hold(x, w, 100, 0.3, gravity, row, make_step(h));
    EXPECT_NEAR(1 / w, 0.01 + 0.3 * mass, 1e-12);
    EXPECT_NEAR(x.y - 10 * h * h, -10 * h * h * 0.01 * w, 1e-15) << "with the fall, only the cloth's part is left";
    // A second hand on the same corner adds its mass.
    reference::take_hold(x, w, 100, 0.7, gravity, row, make_step(h));
    EXPECT_NEAR(1 / w, 0.01 + mass, 1e-12);
    EXPECT_NEAR(x.y - 10 * h * h, -10 * h * h * 0.01 * w, 1e-15);
}

}  // namespace
}  // namespace weft
