// Motion with a known period or a known budget.

#include "specimen.h"

#include <cstdio>
#include <numbers>

namespace weft::physical {
namespace {

// A hanging chain swings in the shape J₀(j √(s/L)), s from its free end, at ω = (j/2) √(g/L) with j = 2.4048, the first
// zero of J₀: T = 1.6684 s for 1 m (Daniel Bernoulli 1732).
double swinging_period(std::uint32_t links, double h) {
    constexpr double j = 2.404825557695773, amplitude = 0.005;
    Fabric fabric;
    fabric.body = {.density = 0.2f, .damping = 0};
    fabric.stretch.inextensible = true;
    fabric.bend = {.bend = {0, 0, 0}};
    Specimen cloth(make_sheet({.size = {1.0f / static_cast<float>(links), 1},
                               .resolution = {2, links + 1},
                               .rotation_degrees = {90, 0, 0},
                               .position = {0, -0.5f, 0},
                               .fabric = fabric,
                               .pinned = [](Vec3 p) { return p.z < -0.499f; }}),
                   {.dt = 10 * h, .substeps = 10, .iterations = 2});
    cloth.place([](Vec3 p) {
        const double s = std::max(0.0, 1.0 + p.y);
        return Vec3{p.x, p.y, static_cast<float>(amplitude * std::cyl_bessel_j(0, j * std::sqrt(s)))};
    });
    std::vector<double> crossings;
    double before = amplitude;
    for (int frame = 1; crossings.size() < 7 && frame * 10 * h < 10; ++frame) {
        cloth.step();
        const double now = cloth.position(2 * links).z;
        if (before * now < 0) crossings.push_back((frame - now / (now - before)) * 10 * h);
        before = now;
    }
    EXPECT_EQ(crossings.size(), 7u);
    EXPECT_EQ(cloth.reports(), report_none);
    return (crossings.back() - crossings.front()) / 3;
}

TEST(SwingingSheet, has_the_period_of_a_hanging_chain) {
    const double exact = 4 * std::numbers::pi / 2.404825557695773 / std::sqrt(double{Specimen::gravity});
    EXPECT_NEAR(exact, 1.6684, 5e-5);
    for (const double h : {1.0 / 1200, 1.0 / 4800}) {
        const double omega = 2 * std::numbers::pi / exact;
        // The period under implicit Euler.
        const double expected = 2 * std::numbers::pi * h / std::atan(omega * h);
        const double period = swinging_period(32, h);
        std::printf("  swing  h 1/%4.0f s  T %.5f s, %+.3f %%\n", 1 / h, period, 100 * (period / expected - 1));
        EXPECT_NEAR(period / expected, 1, 0.005) << "h = " << h;
    }
}

// The sum of potential, kinetic, stretch and bend energy. Under implicit Euler it can only fall. With K = 4000 N/m one
// iteration per substep does not solve the constraints exactly, and the bound is a measured value.
TEST(Energy, of_motion_height_stretch_and_bend_never_rises_together) {
    struct Case {
        float stiffness;
        double bound;  // of weight times side, in a frame
        BendModel model = BendModel::dihedral;
    };
    for (const auto& [stiffness, bound, model] :
         {Case{60, 1e-7}, Case{4000, 1e-3}, Case{60, 1e-7, BendModel::plate}, Case{4000, 1e-3, BendModel::plate}}) {
        Fabric fabric;
        fabric.body = {.density = 0.2f, .damping = 0};
        fabric.stretch = {
            .stretch = {stiffness, stiffness}, .compression = {stiffness, stiffness}, .shear = 0.1f * stiffness};
        fabric.bend.model = model;
        Specimen cloth(
            make_sheet({.fabric = fabric, .pinned = [](Vec3 p) { return p.z < -0.49f && std::abs(p.x) > 0.49f; }}),
            {.dt = 1.0 / 120, .substeps = 20, .iterations = 1});
        const double scale = 0.2 * Specimen::gravity * 1;  // its weight times its side
        double before = measure_energy(cloth).total(), worst = 0;
        const double start = before;
        for (int frame = 0; frame < 360; ++frame) {
            cloth.step();
            const double now = measure_energy(cloth).total();
            worst = std::max(worst, (now - before) / scale);
            before = now;
        }
        std::printf("  energy  K %4.0f N/m, %s  largest rise in a frame %.1e, lost in 3 s %.3f of weight x side\n",
                    static_cast<double>(stiffness), model == BendModel::plate ? "plate" : "hinges", worst,
                    (start - before) / scale);
        EXPECT_LE(worst, bound) << stiffness << " N/m";
        EXPECT_LT(before, start);
    }
}

}  // namespace
}  // namespace weft::physical
