#include "physics/stitch/stitch.h"

#include "physics/testing.h"

#include <array>
#include <cmath>

namespace weft {
namespace {

using namespace testing_kernels;
using reference::StitchRow;

struct Six {
    std::array<vec3, 6> x;
    std::array<double, 6> w;

    double project(const StitchRow& row, const reference::Step& step, double lambda = 0) {
        reference::project_stitch(x[0], x[1], x[2], x[3], x[4], x[5], w[0], w[1], w[2], w[3], w[4], w[5], lambda, row,
                                  step);
        return lambda;
    }
    vec3 across(const StitchRow& row) const {
        return reference::across_stitch(x[0], x[1], x[2], x[3], x[4], x[5], row);
    }
};

// Two triangles at random, and a point on each.
Six random_points(Random& random, StitchRow& row, double gap, double compliance) {
    Six six;
    for (vec3& x : six.x) x = random.vector(1);
    for (double& w : six.w) w = random.number(0.5, 3);
    const double a = random.number(0, 0.5), b = random.number(0, 0.5), c = random.number(0, 0.5),
                 d = random.number(0, 0.5);
    row = {a, b, 1 - a - b, -c, -d, c + d - 1, gap, compliance};
    return six;
}

TEST(Stitch, closes_the_gap_in_one_projection_where_it_is_rigid) {
    Random random(1);
    for (int i = 0; i < 200; ++i) {
        StitchRow row{};
        const double gap = i % 2 == 0 ? 0 : 0.1;
        Six six = random_points(random, row, gap, 0);
        six.project(row, make_step(0.01));
        EXPECT_NEAR(norm(six.across(row)), gap, 1e-12);
    }
}

TEST(Stitch, moves_along_the_gradient) {
    Random random(2);
    for (int i = 0; i < 200; ++i) {
        StitchRow row{};
        Six six = random_points(random, row, 0.05, 1e-4);
        std::array<vec3, 6> points = six.x;
        const reference::Step step = make_step(0.01);
        const double c = norm(six.across(row)) - row.gap;
        const double lambda = six.project(row, step);
        double weight = 0;
        const double shares[6] = {row.c0, row.c1, row.c2, row.c3, row.c4, row.c5};
        for (int k = 0; k < 6; ++k) weight += six.w[k] * shares[k] * shares[k];
        EXPECT_NEAR(lambda, -c / (weight + 1e-4 * step.inv_h2), 1e-12);
        std::array<vec3, 6> gradients;
        for (int k = 0; k < 6; ++k) gradients[k] = (six.x[k] - points[k]) * (1 / (six.w[k] * lambda));
        Six at = six;
        expect_gradient(
            points, gradients,
            [&] {
                at.x = points;
                return norm(at.across(row)) - row.gap;
            },
            1e-8);
    }
}

TEST(Stitch, keeps_momentum) {
    Random random(3);
    for (int i = 0; i < 200; ++i) {
        StitchRow row{};
        Six six = random_points(random, row, 0.2, 0);
        const auto before = six.x;
        six.project(row, make_step(0.01));
        vec3 linear(0.0), angular(0.0);
        for (int k = 0; k < 6; ++k) {
            const vec3 moved = (six.x[k] - before[k]) * (1 / six.w[k]);
            linear = linear + moved;
            angular = angular + reference::cross(before[k], moved);
        }
        EXPECT_LT(norm(linear), 1e-12);
        EXPECT_LT(norm(angular), 1e-12);
    }
}

TEST(Stitch, of_pinned_or_coincident_points_does_nothing) {
    Random random(4);
    StitchRow row{};
    Six six = random_points(random, row, 0, 0);
    six.w.fill(0);
    const auto before = six.x;
    EXPECT_EQ(six.project(row, make_step(0.01)), 0);
    for (int k = 0; k < 6; ++k) EXPECT_EQ(norm(six.x[k] - before[k]), 0);
    six.w.fill(1);
    six.x.fill(vec3(1, 2, 3));
    EXPECT_EQ(six.project(row, make_step(0.01)), 0);
    for (int k = 0; k < 6; ++k) EXPECT_EQ(norm(six.x[k] - vec3(1, 2, 3)), 0);
}

TEST(AddStitch, leaves_out_particles_without_a_share) {
    RowList rows = make_rows(ConstraintKind::stitch);
    EXPECT_TRUE(add_stitch(rows, {{7, 8, 9}, {1, 0, 0}}, {{20, 21, 22}, {0, 1, 0}}, 0.01f, 1e-4f));
    constexpr std::uint32_t no = no_particle;
    EXPECT_EQ(rows.particles, (std::vector<std::uint32_t>{7, 21, no, no, no, no}));
    EXPECT_EQ(rows.fields, (std::vector<float>{1, -1, 0, 0, 0, 0, 0.01f, 1e-4f}));
}

TEST(AddStitch, moves_a_particle_of_both_points_by_the_difference) {
    RowList rows = make_rows(ConstraintKind::stitch);
    EXPECT_TRUE(add_stitch(rows, {{1, 2, 3}, {0.5f, 0.5f, 0}}, {{2, 3, 4}, {0.25f, 0.75f, 0}}, 0, 0));
    constexpr std::uint32_t no = no_particle;
    EXPECT_EQ(rows.particles, (std::vector<std::uint32_t>{1, 2, 3, no, no, no}));
    EXPECT_EQ(rows.fields, (std::vector<float>{0.5f, 0.25f, -0.75f, 0, 0, 0, 0, 0}));
}

TEST(AddStitch, of_a_point_to_itself_is_none) {
    RowList rows = make_rows(ConstraintKind::stitch);
    EXPECT_FALSE(add_stitch(rows, {{5, 6, 7}, {1, 0, 0}}, {{4, 5, 6}, {0, 1, 0}}, 0, 0));
    EXPECT_EQ(rows.size(), 0u);
}

}  // namespace
}  // namespace weft
