// Free motion: constraints conserve momentum.

#include "physics/testing.h"
#include "sheet.h"
#include "specimen.h"

#include <numbers>

namespace weft::physical {
namespace {

// One mass on one compliant distance, as in Macklin, Müller, Chentanez 2016, "XPBD", section 6.1: rest 1 m, start
// 1.5 m, compliance 0.001 m/N, 1 kg. The scheme is implicit Euler for a linear spring: its period is
// 2πh/atan(ωh), and it decays as (1 + ω²h²)^(-1/2) a step.
TEST(Oscillator, has_the_period_and_decay_of_implicit_euler) {
    using namespace reference;
    for (const double h : {1e-3, 1e-4}) {
        const double omega = std::sqrt(1 / 0.001);
        vec3 anchor(0.0), x(1.5, 0, 0);
        Motion m{vec3(0.0), vec3(0.0), vec3(0.0)};
        const Step step = step_without_limits(h, 1 / h, 1 / (h * h));
        std::vector<double> crossings;
        double before = 0.5, peak = 0, peak_time = 0;
        for (int i = 1; crossings.size() < 21; ++i) {
            const vec3 start = x;
            predict(x, m, 1.0, vec3(0.0), 1e9, step);
            double lambda = 0;
            project_stretch(x, anchor, 1.0, 0.0, lambda, StretchRow{1, 0.001, 0.001, WEFT_NEVER_STRAIGHT}, step);
            update_velocity(m, x, start, 1.0, 1e9, step);
            const double now = x.x - 1;
            if (crossings.size() >= 10 && now > peak) peak = now, peak_time = i * h;
            if (before * now < 0) crossings.push_back((i - now / (now - before)) * h);
            before = now;
        }
        const double period = (crossings[20] - crossings[0]) / 10;
        EXPECT_NEAR(period, 2 * std::numbers::pi * h / std::atan(omega * h), 1e-6);
        EXPECT_NEAR(period, 0.19869, h == 1e-4 ? 1e-5 : 1e-3 * 0.19869);
        const double expected = 0.5 * std::pow(1 + omega * omega * h * h, -0.5 * peak_time / h);
        EXPECT_NEAR(peak, expected, 0.02 * expected);
    }
}

TEST(FreeFall, is_that_of_semi_implicit_euler) {
    for (const std::uint32_t substeps : {1u, 20u, 60u}) {
        World world = make_world({.solver = {.substeps = substeps}}, {.position = {0.3f, 10, -0.2f}});
        const double y0 = center_of_mass(world.frame().cloths[0]).y;
        run(world, 1);
        const double h = 1.0 / 60 / substeps, g = -9.81;
        const Vec3 center = center_of_mass(world.frame().cloths[0]);
        EXPECT_NEAR((center.y - y0) / (0.5 * g * 1 * (1 + h)), 1, 1e-5) << substeps;
        EXPECT_NEAR(center.x, 0.3f, 1e-6f);
        const Strain strain = measure_strain(world.frame());
        EXPECT_LT(strain.stretch.max, 1e-4) << "falling together, nothing pulls";
        for (const Vec4& v : world.frame().cloths[0].velocities) EXPECT_NEAR(v.y / g, 1, 2e-4);
    }
}

struct Momentum {
    double linear[3] = {}, angular[3] = {};
};

Momentum total_of(const LoneCloth& cloth) {
    Momentum sum;
    for (std::uint32_t p = 0; p < cloth.model().particle_count; ++p) {
        const double m = cloth.model().mass[p];
        const Vec4 &x = cloth.now().position[p], &v = cloth.now().velocity[p];
        const double pos[3] = {x.x, x.y, x.z}, vel[3] = {v.x, v.y, v.z};
        for (int k = 0; k < 3; ++k) {
            const int i = (k + 1) % 3, j = (k + 2) % 3;
            sum.linear[k] += m * vel[k];
            sum.angular[k] += m * (pos[i] * vel[j] - pos[j] * vel[i]);
        }
    }
    return sum;
}

// A creased sheet is thrown with a spin and strong damping, without gravity. Its momentum is conserved.
TEST(FreeFall, constraints_and_damping_keep_momentum) {
    Fabric fabric;
    fabric.body.damping = 5;
    const auto model = make_sheet({.rotation_degrees = {30, 0, 0}, .fabric = fabric});
    LoneCloth cloth(model, {.solver = {.substeps = 20, .iterations = 1}, .contacts = false});
    for (std::uint32_t p = 0; p < model->particle_count; ++p) {
        const Vec3 x = cloth.now().position[p].xyz();
        const Vec3 v = Vec3{0.3f, 0.1f, -0.2f} + cross({0.5f, 2, 1}, x) + Vec3{0, std::abs(x.x), 0};
        cloth.now().velocity[p] = {v.x, v.y, v.z, 0};
    }
    const Momentum before = total_of(cloth);
    for (int i = 0; i < 60; ++i) cloth.step(1.0 / 60, {});
    const Momentum after = total_of(cloth);
    // Every row conserves momentum exactly, but rounds positions of half a meter to 3e-8 m, which over a substep of
    // 1/1200 s reads as 4e-5 m/s. 1200 substeps of that, averaged over the sheet, are the tolerance.
    const double mass = 0.14, scale_linear = mass * 0.37, scale_angular = std::abs(before.angular[1]);
    for (int k = 0; k < 3; ++k) {
        EXPECT_NEAR(after.linear[k], before.linear[k], 5e-3 * scale_linear) << k;
        EXPECT_NEAR(after.angular[k], before.angular[k], 1e-2 * scale_angular) << k;
    }
}

TEST(Energy, never_rises_without_something_that_drives) {
    World world =
        make_world({.solver = {.substeps = 20}}, {.rotation_degrees = {90, 0, 0}, .position = {}, .pinned = [](Vec3 p) {
                                                      return p.z < -0.49f && std::abs(p.x) > 0.49f;
                                                  }});
    const auto energy = [&] {
        const ClothFrame& cloth = world.frame().cloths[0];
        double potential = 0;
        for (std::uint32_t i = 0; i < cloth.model->particle_count; ++i) {
            if (cloth.positions[i].w > 0) potential += 9.81 * cloth.model->mass[i] * cloth.positions[i].y;
        }
        return potential + kinetic_energy(world.frame());
    };
    double highest = energy();
    const double start = highest;
    for (int i = 0; i < 240; ++i) {
        world.step(1.0 / 60);
        // Elastic energy is not counted; it may become kinetic energy, but it is small.
        EXPECT_LT(energy(), highest + 2e-3 * std::abs(start)) << "frame " << i;
    }
    EXPECT_LT(energy(), start);
}

}  // namespace
}  // namespace weft::physical
