// The mean flow of each kind of wind against its formula, and the bounds of a source.
#include "physics/air/winds.def"
#include "physics/testing.h"

#include <limits>

namespace weft {
namespace {

using namespace testing_kernels;
using reference::Flow;

vec3 wide(Vec3 v) {
    return {v.x, v.y, v.z};
}

reference::WindNumbers numbers_of(const WindValues& v) {
    return {wide(v.vectors[0]), wide(v.vectors[1]), wide(v.vectors[2]), v.numbers[0], v.numbers[1], v.numbers[2]};
}

// A jet along x of 10 m/s from a nozzle of 0.2 m.
Flow jet(vec3 p) {
    return reference::flow_jet(p, numbers_of(wind_values(JetDesc{0.2f}, {10, 0, 0})));
}

TEST(Jet, has_its_full_speed_for_six_diameters_and_then_falls_as_one_over_x) {
    for (const double x : {0.0, 0.1, 0.7, 1.199}) EXPECT_NEAR(jet({x, 0, 0}).velocity.x, 10, 1e-6) << x;
    for (const double x : {1.2, 1.5, 3.0, 20.0}) EXPECT_NEAR(jet({x, 0, 0}).velocity.x, 10 * 1.2 / x, 1e-6) << x;
}

TEST(Jet, has_half_of_that_at_a_tenth_of_x_and_the_profile_of_gauss) {
    Random random(1);
    for (const double x : {1.2, 2.0, 10.0}) {
        const double axis = jet({x, 0, 0}).velocity.x;
        for (int i = 0; i < 50; ++i) {
            const double angle = random.number(0, 6.28), r = random.number(0, 0.5 * x);
            const vec3 across(0, std::cos(angle), std::sin(angle));
            EXPECT_NEAR(jet(vec3(x, 0, 0) + across * (0.1 * x)).velocity.x, axis / 2, 1e-6 * axis);
            const double expected = axis * std::exp2(-std::pow(r / (0.1 * x), 2));
            EXPECT_NEAR(jet(vec3(x, 0, 0) + across * r).velocity.x, expected, 1e-6 * axis) << x << ' ' << r;
        }
    }
}

TEST(Jet, is_still_behind_the_nozzle_and_leaves_it_with_its_width) {
    for (const double r : {0.0, 0.05, 1.0}) EXPECT_EQ(norm(jet({-1e-6, r, 0}).velocity), 0);
    EXPECT_NEAR(jet({0, 0.099, 0}).velocity.x, 10, 1e-6);
    EXPECT_LT(jet({0, 0.13, 0}).velocity.x, 0.1);
}

TEST(Jet, has_no_step_in_front_of_the_nozzle) {
    Random random(2);
    for (int i = 0; i < 5000; ++i) {
        const vec3 p(random.number(0.001, 3), random.number(-0.5, 0.5), random.number(-0.5, 0.5));
        EXPECT_LT(norm(jet(p).velocity - jet(p + random.vector(1e-5)).velocity), 0.02) << p.x;
    }
}

TEST(Jet, carries_the_momentum_of_its_nozzle) {
    // ∫ u² dA over the nozzle: 100 · π/4 · 0.04. Pope's widths give 4 % more downstream.
    const double pi = 3.14159265358979, nozzle = 100 * pi / 4 * 0.04;
    for (const double x : {1.2, 2.0, 5.0}) {
        double sum = 0;
        const double dr = x * 1e-4;
        for (double r = dr / 2; r < x; r += dr) sum += std::pow(jet({x, r, 0}).velocity.x, 2) * 2 * pi * r * dr;
        EXPECT_NEAR(sum / nozzle, 1.039, 0.002) << x;
    }
}

Flow vortex(vec3 p, const VortexDesc& desc, Vec3 on_axis = {}) {
    return reference::flow_vortex(p, numbers_of(wind_values(desc, on_axis)));
}

TEST(Vortex, turns_as_lamb_and_oseen_say) {
    // v = V (1 + 1/(2α)) (R/r) (1 − exp(−α r²/R²)), α = 1.25643.
    const double alpha = 1.25643120862616968;
    const VortexDesc desc{.swirl = 4, .inflow = 1.5f, .radius = 0.3f};
    const double radius = desc.radius;
    Random random(3);
    for (int i = 0; i < 500; ++i) {
        const double r = std::pow(10, random.number(-4, 2)), angle = random.number(0, 6.28);
        const vec3 out(std::cos(angle), 0, std::sin(angle)), around = reference::cross(vec3(0, 1, 0), out);
        const double part = (1 + 1 / (2 * alpha)) * (radius / r) * -std::expm1(-alpha * r * r / radius / radius);
        const vec3 u = vortex(out * r + vec3(0, random.number(-9, 9), 0), desc).velocity;
        EXPECT_LT(norm(u - (around * (4 * part) - out * (1.5 * part))), 2e-6) << r;
    }
}

TEST(Vortex, is_fastest_at_its_radius_and_finite_on_its_axis) {
    const VortexDesc desc{.swirl = 4, .radius = 0.3f};
    EXPECT_NEAR(norm(vortex({0.3, 0, 0}, desc).velocity), 4, 1e-6);
    for (const double r : {0.29, 0.31}) EXPECT_LT(norm(vortex({r, 0, 0}, desc).velocity), 4);
    EXPECT_EQ(norm(vortex({0, 5, 0}, desc).velocity), 0);
    const vec3 up = vortex({0, 5, 0}, desc, {0, 3, 0}).velocity;
    EXPECT_NEAR(up.y, 3, 1e-6) << "an updraft is fastest on the axis";
    EXPECT_NEAR(vortex({0.3, 0, 0}, desc, {0, 3, 0}).velocity.y, 3 * std::exp(-1.2564312), 1e-6);
}

TEST(Flow, of_every_kind_has_two_coordinates_that_do_not_change_along_it) {
    Random random(4);
    const auto check = [&](const auto& flow_at, bool straight) {
        for (int i = 0; i < 300; ++i) {
            const vec3 p = random.vector(1);
            const Flow flow = flow_at(p);
            const double speed = norm(flow.velocity);
            if (!(speed > 1e-3)) continue;
            const double step = straight ? 0.1 : 1e-6;
            const Flow next = flow_at(p + flow.velocity * (step / speed));
            EXPECT_NEAR(next.q1, flow.q1, 1e-6 * step + 1e-9);
            EXPECT_NEAR(next.q2, flow.q2, 1e-6 * step + 1e-9);
        }
    };
    check([](vec3 p) { return jet(p); }, true);
    check([](vec3 p) { return vortex(p, VortexDesc{.swirl = 4, .radius = 0.3f}); }, false);
}

TEST(Flow, is_finite_everywhere) {
    for (const float diameter : {1e-6f, 1e6f}) {
        for (const float speed : {0.0f, 1e4f}) {
            const WindValues of_jet = wind_values(JetDesc{diameter}, {speed, 0, 0}),
                             of_vortex = wind_values(VortexDesc{speed, -speed, diameter}, {0, speed, 0});
            for (const float far : {0.0f, 1e-30f, 1e-7f, 1.0f, 1e6f, 1e15f}) {
                const auto finite_at = [&](const WindValues& v, const auto& flow_of) {
                    const auto s = [](Vec3 x) { return scalar::vec3(x.x, x.y, x.z); };
                    const scalar::WindNumbers n{s(v.vectors[0]), s(v.vectors[1]), s(v.vectors[2]),
                                                v.numbers[0],    v.numbers[1],    v.numbers[2]};
                    for (const scalar::vec3 p : {scalar::vec3(far, 0, 0), scalar::vec3(-far, far, -far)}) {
                        const scalar::vec3 u = flow_of(p, n).velocity;
                        EXPECT_LE(scalar::dot(u, u), 3.1f * speed * speed * 1.001f) << far << ' ' << diameter;
                    }
                };
                finite_at(of_jet, [](scalar::vec3 p, scalar::WindNumbers n) { return scalar::flow_jet(p, n); });
                finite_at(of_vortex, [](scalar::vec3 p, scalar::WindNumbers n) { return scalar::flow_vortex(p, n); });
            }
        }
    }
}

TEST(WindShare, is_one_in_the_box_and_falls_smoothly_to_nothing_over_the_border) {
    const reference::WindBounds bounds{vec3(1, 0, 0), vec3(0, 1, 0), vec3(0, 0, 1), vec3(1.5, 2.5, 3.5), 2, 1};
    const auto at = [&](vec3 p) { return reference::wind_share(p, bounds); };  // 1 × 2 × 3 with a border of 0.5
    EXPECT_EQ(at({0.99, -1.99, 2.99}), 1);
    EXPECT_NEAR(at({1.25, 0, 0}), 0.5, 1e-12);
    EXPECT_NEAR(at({1.05, 0, 0}), 0.972, 1e-12) << "flat at its ends";
    EXPECT_NEAR(at({1.25, -2.25, 3.25}), 0.125, 1e-12);
    EXPECT_EQ(at({-1.5, 0, 0}), 0);
    EXPECT_EQ(at({0, 2.51, 0}), 0);
    EXPECT_EQ(at({0, 0, -1e6}), 0);
    double last = 1;
    for (double x = 0.9; x < 1.6; x += 1e-3) {
        EXPECT_LE(at({x, 0, 0}), last);
        EXPECT_LT(last - at({x, 0, 0}), 4e-3);
        last = at({x, 0, 0});
    }
}

}  // namespace
}  // namespace weft
