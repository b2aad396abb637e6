#include "physics/testing.h"

#include <cmath>
#include <limits>
#include <numbers>

namespace weft {
namespace {

using namespace testing_kernels;
using reference::PlaneStress;
using reference::TearSide;
using reference::Tension;

PlaneStress stress(double xx, double yy, double xy) {
    return {(xx + yy) / 2, (xx - yy) / 2, xy};
}

TearSide side_at(double degrees, double rest, double pull, double push, double play = WEFT_NEVER_STRAIGHT) {
    const double angle = degrees * std::numbers::pi / 180;
    return {rest, pull, push, std::cos(angle), std::sin(angle), play};
}

// Of a spring per area: the integral of its force, whose stiffness grows to 50 times from half of `play` to one and a
// half times it.
double spring_energy(const TearSide& side, double strain) {
    const double from = strain - 0.5 * side.play;
    double more = 0;
    if (from > side.play) {
        more = side.play * side.play / 6 + 0.5 * from * (from - side.play);
    } else if (from > 0) {
        more = from * from * from / (6 * side.play);
    }
    return (strain > 0 ? side.pull : side.push) * (0.5 * strain * strain + 49 * more);
}

TEST(Tear, finds_principal_tension_and_its_direction) {
    Random random(1);
    for (int i = 0; i < 2000; ++i) {
        const double xx = random.number(-5, 5), yy = random.number(-5, 5), xy = random.number(-5, 5);
        const Tension t = reference::principal_tension(stress(xx, yy, xy));
        EXPECT_NEAR(t.x * t.x + t.y * t.y, 1, 1e-12);
        EXPECT_NEAR(xx * t.x + xy * t.y, t.most * t.x, 1e-11);
        EXPECT_NEAR(xy * t.x + yy * t.y, t.most * t.y, 1e-11);
        EXPECT_NEAR(t.most + t.least, xx + yy, 1e-11);
        EXPECT_GE(t.most, t.least);
    }
}

TEST(Tear, survives_equal_principal_values_and_extremes) {
    for (const double size : {0.0, 1e-30, 1.0, 1e9}) {
        for (const auto& [xx, yy, xy] :
             {std::array{1.0, 1.0, 0.0}, std::array{-1.0, -1.0, 0.0}, std::array{1.0, 1.0, 1e-17},
              std::array{1.0, 1.0 + 1e-16, 0.0}, std::array{0.0, 1.0, 0.0}, std::array{0.0, 0.0, -1.0}}) {
            const auto f = [&](double v) { return static_cast<float>(v * size); };
            const scalar::Tension t = scalar::principal_tension({(f(xx) + f(yy)) / 2, (f(xx) - f(yy)) / 2, f(xy)});
            EXPECT_TRUE(std::isfinite(t.most) && std::isfinite(t.least)) << size;
            EXPECT_NEAR(t.x * t.x + t.y * t.y, 1, 1e-6) << size << ' ' << xx << ' ' << yy << ' ' << xy;
        }
    }
    const Tension alike = reference::principal_tension(stress(3, 3, 0));
    EXPECT_EQ(alike.most, 3);
    EXPECT_EQ(alike.x, 1);
    const Tension weft = reference::principal_tension(stress(0, 2, 0));
    EXPECT_EQ(std::abs(weft.y), 1);
    EXPECT_EQ(weft.x, 0);
}

TEST(Tear, turning_keeps_the_tensor) {
    Random random(2);
    for (int i = 0; i < 200; ++i) {
        const PlaneStress s = stress(random.number(-2, 2), random.number(-2, 2), random.number(-2, 2));
        const double angle = random.number(-4, 4);
        const PlaneStress turned = reference::turn_stress(s, std::cos(2 * angle), std::sin(2 * angle));
        const Tension before = reference::principal_tension(s), after = reference::principal_tension(turned);
        EXPECT_NEAR(before.most, after.most, 1e-12);
        const double x = before.x * std::cos(angle) - before.y * std::sin(angle);
        const double y = before.x * std::sin(angle) + before.y * std::cos(angle);
        EXPECT_NEAR(std::abs(x * after.x + y * after.y), 1, 1e-9);
    }
}

TEST(Tear, a_side_pulls_and_pushes_along_itself) {
    const TearSide side = side_at(30, 2, 100, 40);
    const Tension pulled = reference::principal_tension(
        reference::side_stress(reference::side_strain(vec3(0, 0, 0), vec3(0, 0, 2.02), side), side, side.x, side.y));
    EXPECT_NEAR(pulled.most, 1, 1e-12);
    EXPECT_NEAR(pulled.least, 0, 1e-12);
    EXPECT_NEAR(std::atan2(pulled.y, pulled.x), std::numbers::pi / 6, 1e-12);
    const Tension pushed = reference::principal_tension(
        reference::side_stress(reference::side_strain(vec3(0, 0, 0), vec3(1.98, 0, 0), side), side, side.x, side.y));
    EXPECT_NEAR(pushed.most, 0, 1e-12);
    EXPECT_NEAR(pushed.least, -0.4, 1e-12);
}

// The stress is the derivative of the energy of the springs by the strain: sum of k eps^2/2 per area.
TEST(Tear, is_the_derivative_of_the_energy) {
    Random random(3);
    for (int i = 0; i < 100; ++i) {
        const TearSide sides[] = {
            side_at(random.number(0, 180), 1, random.number(1, 9), random.number(1, 9), random.number(0, 0.1)),
            side_at(random.number(0, 180), 1, random.number(1, 9), random.number(1, 9), random.number(0, 0.1)),
            side_at(random.number(0, 180), 1, random.number(1, 9), random.number(1, 9), random.number(0, 0.1))};
        const double strain[] = {random.number(-0.1, 0.1), random.number(-0.1, 0.1), random.number(-0.1, 0.1)};
        // n^T E n of a side for the strain tensor E.
        const auto along = [](const TearSide& side, const double(&e)[3]) {
            return side.x * side.x * e[0] + side.y * side.y * e[1] + 2 * side.x * side.y * e[2];
        };
        const auto energy = [&](const double(&e)[3]) {
            double sum = 0;
            for (const TearSide& side : sides) {
                const double s = along(side, e);
                sum += spring_energy(side, s);
            }
            return sum;
        };
        PlaneStress total = reference::no_stress();
        for (const TearSide& side : sides)
            total = reference::add_stress(total, reference::side_stress(along(side, strain), side, side.x, side.y), 1);
        constexpr double step = 1e-6;
        for (int k = 0; k < 3; ++k) {
            double more[3] = {strain[0], strain[1], strain[2]}, less[3] = {strain[0], strain[1], strain[2]};
            more[k] += step, less[k] -= step;
            const double slope = (energy(more) - energy(less)) / (2 * step);
            // e[2] stands for xy and yx.
            const double expected = k == 0   ? total.mean + total.difference
                                    : k == 1 ? total.mean - total.difference
                                             : 2 * total.mixed;
            EXPECT_NEAR(slope, expected, 1e-5);
        }
    }
}

// At any stretch and in any position the stress is the derivative of the energy by the stretch tensor U of F = R U.
TEST(Tear, of_a_triangle_is_the_derivative_of_its_energy_at_large_stretch) {
    Random random(4);
    for (int i = 0; i < 200; ++i) {
        double rest[3][2];
        for (auto& x : rest) x[0] = random.number(-1, 1), x[1] = random.number(-1, 1);
        const double area = (rest[1][0] - rest[0][0]) * (rest[2][1] - rest[0][1]) -
                            (rest[1][1] - rest[0][1]) * (rest[2][0] - rest[0][0]);
        if (std::abs(area) < 0.2) continue;
        TearSide sides[3];
        for (int k = 0; k < 3; ++k) {
            const double x = rest[(k + 1) % 3][0] - rest[k][0], y = rest[(k + 1) % 3][1] - rest[k][1];
            const double length = std::hypot(x, y);
            sides[k] = {length, random.number(1, 9), random.number(1, 9), x / length, y / length, random.number(0, 4)};
        }
        const double u[3] = {random.number(0.4, 4), random.number(0.4, 4), random.number(-0.3, 0.3)};  // xx, yy, xy
        const auto stretched = [&](const double(&stretch)[3], int k) {
            return std::array{stretch[0] * rest[k][0] + stretch[2] * rest[k][1],
                              stretch[2] * rest[k][0] + stretch[1] * rest[k][1]};
        };
        const reference::TearCoupling coupling{random.number(0, 9),  random.number(0, 9),  random.number(0, 9),
                                               random.number(-9, 9), random.number(-9, 9), random.number(-9, 9)};
        const auto energy = [&](const double(&stretch)[3]) {
            double sum = 0, green[3];
            for (int k = 0; k < 3; ++k) {
                const auto a = stretched(stretch, k), b = stretched(stretch, (k + 1) % 3);
                const double strain = std::hypot(b[0] - a[0], b[1] - a[1]) / sides[k].rest - 1;
                sum += spring_energy(sides[k], strain);
                green[k] = strain * (1 + 0.5 * strain);
            }
            const auto& [ab, bc, ca, ab_bc, bc_ca, ca_ab] = coupling;
            return sum + 0.5 * (ab * green[0] * green[0] + bc * green[1] * green[1] + ca * green[2] * green[2]) +
                   ab_bc * green[0] * green[1] + bc_ca * green[1] * green[2] + ca_ab * green[2] * green[0];
        };
        // A random frame in space; with an area below 0 the triangle is seen from behind.
        vec3 e1 = random.vector(1), e2 = random.vector(1);
        e1 = e1 * (1 / norm(e1));
        e2 = e2 - e1 * dot(e1, e2);
        e2 = e2 * (1 / norm(e2));
        vec3 points[3];
        for (int k = 0; k < 3; ++k) {
            const auto at = stretched(u, k);
            points[k] = e1 * at[0] + e2 * at[1];
        }
        const auto flat = reference::lay_flat(points[0], points[1], points[2], sides[0], sides[1]);
        const PlaneStress s =
            reference::add_stress(reference::springs_stress(flat, sides[0], sides[1], sides[2]),
                                  reference::coupling_stress(flat, sides[0], sides[1], sides[2], coupling), 1);
        const double expected[3] = {s.mean + s.difference, s.mean - s.difference, 2 * s.mixed};
        for (int k = 0; k < 3; ++k) {
            constexpr double step = 1e-6;
            double more[3] = {u[0], u[1], u[2]}, less[3] = {u[0], u[1], u[2]};
            more[k] += step, less[k] -= step;
            EXPECT_NEAR((energy(more) - energy(less)) / (2 * step), expected[k], 1e-4 + 1e-8 * std::abs(expected[k]))
                << i << ' ' << k;
        }
    }
}

// The second derivative of the energy by a small strain along a direction, as for side_stiffness().
TEST(Tear, stiffness_of_a_coupling_is_that_of_its_stress) {
    Random random(5);
    for (int i = 0; i < 50; ++i) {
        const double x[3] = {0, 1, random.number(0, 1)}, y[3] = {0, random.number(-0.5, 0.5), random.number(0.8, 1.5)};
        TearSide sides[3];
        for (int k = 0; k < 3; ++k) {
            const double dx = x[(k + 1) % 3] - x[k], dy = y[(k + 1) % 3] - y[k], length = std::hypot(dx, dy);
            sides[k] = {length, 0, 0, dx / length, dy / length, WEFT_NEVER_STRAIGHT};
        }
        const reference::TearCoupling coupling{random.number(0, 9),  random.number(0, 9),  random.number(0, 9),
                                               random.number(-9, 9), random.number(-9, 9), random.number(-9, 9)};
        const double angle = random.number(0, 6), turn = random.number(0, 6), strain = 1e-6;
        const double dx = std::cos(angle), dy = std::sin(angle);  // of the strain, in the triangle's axes
        vec3 points[3];
        for (int k = 0; k < 3; ++k) {
            const double along = strain * (dx * x[k] + dy * y[k]);
            points[k] = vec3(x[k] + along * dx, y[k] + along * dy, 0);
        }
        const auto flat = reference::lay_flat(points[0], points[1], points[2], sides[0], sides[1]);
        const PlaneStress s = reference::coupling_stress(flat, sides[0], sides[1], sides[2], coupling);
        const double along = s.mean + s.difference * (dx * dx - dy * dy) + s.mixed * 2 * dx * dy;
        // The same direction in axes that are turned against those of the triangle.
        const double tx = std::cos(angle + turn), ty = std::sin(angle + turn);
        EXPECT_NEAR(along / strain,
                    reference::coupling_stiffness(sides[0], sides[1], sides[2], coupling, std::cos(2 * turn),
                                                  std::sin(2 * turn), tx, ty),
                    1e-4);
    }
}

TEST(Tear, degenerate_sides_have_no_stress) {
    const auto stress = [](scalar::vec3 a, scalar::vec3 b, scalar::vec3 c, scalar::TearSide side) {
        const auto flat = scalar::lay_flat(a, b, c, side, side);
        return scalar::add_stress(scalar::springs_stress(flat, side, side, side),
                                  scalar::coupling_stress(flat, side, side, side, {1e9f, 1e9f, 1e9f, 1, 1, 1}), 1);
    };
    for (const float rest : {0.0f, 1e-30f}) {
        const scalar::TearSide side{rest, 1e9f, 1e9f, 1, 0, WEFT_NEVER_STRAIGHT};
        EXPECT_EQ(scalar::side_strain({0, 0, 0}, {1, 0, 0}, side), 0);
        EXPECT_EQ(stress({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, side).mean, 0);
    }
    // Collapsed now, sound at rest: compressed, finite.
    const scalar::TearSide side{1, 100, 100, 1, 0, WEFT_NEVER_STRAIGHT};
    EXPECT_EQ(stress({1, 1, 1}, {1, 1, 1}, {1, 1, 1}, side).mean, -150);
}

TEST(Tear, strength_between_the_threads_follows_both) {
    EXPECT_NEAR(1 / reference::inverse_strength(1, 0, 1.0 / 50, 1.0 / 200), 50, 1e-12);
    EXPECT_NEAR(1 / reference::inverse_strength(0, 1, 1.0 / 50, 1.0 / 200), 200, 1e-12);
    EXPECT_NEAR(1 / reference::inverse_strength(0.6, 0.8, 1.0 / 70, 1.0 / 70), 70, 1e-12) << "the same everywhere";
    EXPECT_EQ(reference::inverse_strength(0, 1, 1.0 / 50, 0), 0) << "no limit along the weft";
}

// Irwin: the stress is K/sqrt(2 pi r) with K = sqrt(energy · stiffness). The particle's triangles carry less than the
// mean over the first edge, because some of them are behind the end.
TEST(Tear, limit_at_the_end_of_a_cut_is_below_the_mean_over_the_first_edge) {
    const double energy = 3, stiffness = 500, edge = 0.02, intensity = std::sqrt(energy * stiffness);
    const double mean = std::sqrt(2 / std::numbers::pi) * intensity / std::sqrt(edge);
    const double limit = 1 / reference::inverse_cut_limit(stiffness, edge, energy);
    EXPECT_GT(limit, 0.5 * mean);
    EXPECT_LT(limit, mean);
    EXPECT_NEAR(1 / reference::inverse_cut_limit(stiffness, edge / 4, energy), 2 * limit, 1e-9 * limit);
    EXPECT_NEAR(1 / reference::inverse_cut_limit(stiffness, edge, 4 * energy), 2 * limit, 1e-9 * limit);
    EXPECT_EQ(reference::inverse_cut_limit(stiffness, edge, 0), 0);
    EXPECT_EQ(reference::inverse_cut_limit(0, edge, energy), 0);
}

}  // namespace
}  // namespace weft
