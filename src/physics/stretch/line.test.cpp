#include "physics/testing.h"

#include <vector>

namespace weft {
namespace {

using namespace testing_kernels;
using reference::LineRow;
using reference::StretchRow;

// A line of points, solved as in the backends.
struct Line {
    std::vector<vec3> x;
    std::vector<double> w;
    std::vector<StretchRow> rows;
    std::vector<double> lambda;

    std::vector<double> solve(double h) {
        const std::size_t count = rows.size();
        std::vector<LineRow> left(count);
        LineRow before = reference::line_start();
        for (std::size_t k = 0; k < count; ++k) {
            left[k] =
                reference::eliminate_stretch(before, x[k], x[k + 1], w[k], w[k + 1], lambda[k], rows[k], make_step(h));
            if (k > 0) left[k - 1].factor = before.factor;
            before = left[k];
        }
        std::vector<double> change(count + 1);
        for (std::size_t k = count; k-- > 0;) {
            change[k] = reference::substitute_stretch(left[k], change[k + 1]);
            x[k] = x[k] + left[k].n * (w[k] * change[k]);
            x[k + 1] = x[k + 1] - left[k].n * (w[k + 1] * change[k]);
            lambda[k] += change[k];
        }
        change.pop_back();
        return change;
    }
    double stretched(std::size_t k) const { return norm(x[k] - x[k + 1]) - rows[k].rest; }
};

// Within a tenth of its rest shape, so that no pull reaches its limit.
Line random_line(Random& random, std::size_t count, double compliance) {
    Line line;
    vec3 at(0, 0, 0);
    for (std::size_t k = 0; k <= count; ++k) {
        line.x.push_back(at + random.vector(0.01));
        line.w.push_back(random.number(0.5, 2));
        at = at + vec3(1, random.number(-0.3, 0.3), random.number(-0.3, 0.3));
    }
    for (std::size_t k = 0; k < count; ++k) {
        line.rows.push_back({norm(line.x[k] - line.x[k + 1]) + random.number(-0.01, 0.01), compliance, compliance,
                             WEFT_NEVER_STRAIGHT});
    }
    line.lambda.assign(count, 0);
    return line;
}

TEST(StretchLine, solves_the_linear_system_of_its_rows) {
    Random random(1);
    for (int round = 0; round < 100; ++round) {
        const std::size_t count = 1 + random.index(40);
        const double h = 0.01, alpha = random.number(0, 1e-4) / (h * h);
        Line line = random_line(random, count, alpha * h * h);
        if (round % 3 == 0) line.w[random.index(static_cast<std::uint32_t>(count + 1))] = 0;
        for (double& lambda : line.lambda) lambda = random.number(-1e-3, 1e-3);
        const Line before = line;
        const auto change = line.solve(h);
        const auto normal = [&](std::size_t k) {
            const vec3 d = before.x[k] - before.x[k + 1];
            return d * (1 / norm(d));
        };
        for (std::size_t k = 0; k < count; ++k) {
            const double w = before.w[k] + before.w[k + 1];
            const double give = w * std::min(0.1, std::abs(before.stretched(k)) / before.rows[k].rest);
            double left =
                (w * (1 + 1e-4) + std::max(alpha, give)) * change[k] + before.stretched(k) + alpha * before.lambda[k];
            if (k > 0) left -= before.w[k] * reference::dot(normal(k - 1), normal(k)) * change[k - 1];
            if (k + 1 < count) left -= before.w[k + 1] * reference::dot(normal(k), normal(k + 1)) * change[k + 1];
            EXPECT_NEAR(left, 0, 1e-12) << "row " << k << " of " << count;
        }
    }
}

TEST(StretchLine, keeps_momentum) {
    Random random(2);
    for (int round = 0; round < 50; ++round) {
        Line line = random_line(random, 30, 0);
        for (vec3& x : line.x) x = x + random.vector(0.4);  // far off, so that pulls reach their limit
        const Line before = line;
        line.solve(0.01);
        vec3 linear(0, 0, 0), angular(0, 0, 0);
        for (std::size_t k = 0; k < line.x.size(); ++k) {
            const vec3 moved = (line.x[k] - before.x[k]) * (1 / line.w[k]);
            linear = linear + moved;
            angular = angular + reference::cross(before.x[k], moved);
        }
        EXPECT_LT(norm(linear), 1e-12);
        EXPECT_LT(norm(angular), 1e-10);
    }
}

TEST(StretchLine, of_one_row_is_that_row) {
    Random random(3);
    for (int round = 0; round < 50; ++round) {
        Line line = random_line(random, 1, 1e-6);
        vec3 a = line.x[0], b = line.x[1];
        double lambda = 0;
        reference::project_stretch(a, b, line.w[0], line.w[1], lambda, line.rows[0], make_step(0.01));
        line.solve(0.01);
        EXPECT_LT(norm(line.x[0] - a) + norm(line.x[1] - b), 2e-2 * norm(a - b) * 0.02) << "but for the give";
    }
}

// A hundred constraints hang from a pin and have fallen for one step: the error is everywhere, its cause at one end.
TEST(StretchLine, brings_a_long_line_to_its_lengths_at_once) {
    constexpr std::size_t count = 100;
    Line line, sweep;
    for (std::size_t k = 0; k <= count; ++k) {
        line.x.push_back(vec3(0, -0.01 * static_cast<double>(k) - (k > 0 ? 1e-5 : 0), 0));
        line.w.push_back(k > 0 ? 1 : 0);
    }
    line.rows.assign(count, StretchRow{0.01, 0, 0, WEFT_NEVER_STRAIGHT});
    line.lambda.assign(count, 0);
    sweep = line;
    for (int i = 0; i < 5; ++i) line.solve(0.001);
    for (int i = 0; i < 5; ++i) {
        for (std::size_t k = 0; k < count; ++k) {
            reference::project_stretch(sweep.x[k], sweep.x[k + 1], sweep.w[k], sweep.w[k + 1], sweep.lambda[k],
                                       sweep.rows[k], make_step(0.001));
        }
    }
    const auto fallen = [](const Line& l) { return -1 - l.x.back().y; };
    EXPECT_NEAR(fallen(line), 0, 1e-6);
    EXPECT_GT(fallen(sweep), 9e-6) << "row after row nothing of it has come to the other end";
}

TEST(StretchLine, converges_to_the_forces_of_its_springs) {
    Random random(4);
    const double h = 0.01, compliance = 1e-5;
    Line line = random_line(random, 20, compliance);
    line.w.front() = line.w.back() = 0;
    for (int i = 0; i < 100; ++i) line.solve(h);
    for (std::size_t k = 0; k < 20; ++k) {
        EXPECT_NEAR(line.stretched(k) + compliance / (h * h) * line.lambda[k], 0, 1e-9);
    }
}

TEST(StretchLine, goes_around_rows_without_stiffness) {
    Random random(5);
    Line line = random_line(random, 9, 0);
    line.rows[4] = {line.rows[4].rest, -1, -1, WEFT_NEVER_STRAIGHT};
    Line left = line, right = line;
    left.rows.resize(4), left.lambda.resize(4);
    right.x.erase(right.x.begin(), right.x.begin() + 5), right.w.erase(right.w.begin(), right.w.begin() + 5);
    right.rows.erase(right.rows.begin(), right.rows.begin() + 5), right.lambda.resize(4);
    line.solve(0.01), left.solve(0.01), right.solve(0.01);
    for (std::size_t k = 0; k < 5; ++k) {
        EXPECT_LT(norm(line.x[k] - left.x[k]), 1e-12);
        EXPECT_LT(norm(line.x[k + 5] - right.x[k]), 1e-12);
    }
}

// Taut between two pins and too long or too short: there is no solution, but the line must stay stable.
TEST(StretchLine, stays_calm_between_pins_that_are_too_far_apart) {
    for (const double strain : {0.02, 0.5, -0.1}) {
        Line line;
        constexpr std::size_t count = 32;
        for (std::size_t k = 0; k <= count; ++k) {
            line.x.push_back(vec3((1 + strain) * static_cast<double>(k), k % 2 ? 0.01 : -0.01, 0));
            line.w.push_back(k == 0 || k == count ? 0 : 1);
        }
        line.rows.assign(count, StretchRow{1, 0, 0, WEFT_NEVER_STRAIGHT});
        line.lambda.assign(count, 0);
        double largest = 0;
        for (int i = 0; i < 200; ++i) {
            line.solve(0.01);
            for (const vec3& x : line.x) largest = std::max(largest, std::abs(x.y));
        }
        EXPECT_LT(largest, 0.6) << strain;
    }
}

TEST(StretchLine, survives_degenerate_input) {
    using namespace scalar;
    for (const float w : {0.0f, 1.0f, 1e30f}) {
        for (const float gap : {0.0f, 1e-30f, 1e-12f, 1.0f, 1e12f}) {
            for (const float compliance : {-1.0f, 0.0f, 1.0f, 1e30f}) {
                scalar::LineRow before = line_start();
                float change = 0;
                for (int k = 0; k < 4; ++k) {
                    const scalar::vec3 a(gap * static_cast<float>(k), 1, 1), b(gap * static_cast<float>(k + 1), 1, 1);
                    const auto now =
                        eliminate_stretch(before, a, b, w, 0.0f, 0.0f, {1, compliance, compliance, WEFT_NEVER_STRAIGHT},
                                          step_without_limits(1e-3f, 1e3f, 1e6f));
                    change = substitute_stretch(now, change);
                    EXPECT_TRUE(std::isfinite(before.factor) && std::isfinite(change) && std::isfinite(now.n.x))
                        << w << ' ' << gap << ' ' << compliance;
                    before = now;
                }
            }
        }
    }
}

}  // namespace
}  // namespace weft
