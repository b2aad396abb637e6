// Cloth in air: how fast it falls, and what wind does to it.

#include "sheet.h"

#include <cstdio>

namespace weft::physical {
namespace {

WindDesc wind(Vec3 velocity) {
    return {.velocity = velocity};
}

TEST(TerminalVelocity, of_a_sheet_that_falls_broadside) {
    // √(2 ρ_A g/(ρ C_D)), for air of 1.225 kg/m³ and C_D = 1.28.
    for (const auto& [density, expected] : {std::pair{0.05f, 0.791}, {0.1f, 1.119}, {0.2f, 1.582}, {0.3f, 1.937}}) {
        SheetDesc sheet;
        sheet.fabric.body.density = density;
        World world = make_world({.air = AirDesc{}}, sheet);
        run(world, 3);
        const Vec3 before = center_of_mass(world.frame().cloths[0]);
        run(world, 1);
        const Vec3 after = center_of_mass(world.frame().cloths[0]);
        std::printf("  terminal velocity  %.2f kg/m²  %.4f m/s, %+.2f %%\n", static_cast<double>(density),
                    static_cast<double>(before.y - after.y), 100 * ((before.y - after.y) / expected - 1));
        EXPECT_NEAR((before.y - after.y) / expected, 1, 0.01) << density;
        EXPECT_NEAR(after.x, 0, 1e-3) << "flat as it is, it falls straight";
    }
}

TEST(TerminalVelocity, does_not_depend_on_the_time_step) {
    for (const std::uint32_t substeps : {5u, 20u, 80u}) {
        World world = make_world({.solver = {.substeps = substeps}, .air = AirDesc{}}, SheetDesc{});
        run(world, 3);
        const double h = 1.0 / 60 / substeps, v = -world.frame().cloths[0].velocities[40].y;
        const double expected = std::sqrt(2 * 0.14 * 9.81 / (1.225 * 1.28));
        // Gravity acts before the air does, so the speed is larger by the gain of one substep.
        EXPECT_NEAR(v, expected + 0.5 * 9.81 * h, 0.01 * expected) << substeps;
    }
}

TEST(Air, of_no_density_is_a_vacuum) {
    World with = make_world({.air = AirDesc{.density = 0, .wind = {wind({9, 0, 0})}}}, SheetDesc{});
    World without = make_world({}, SheetDesc{});
    run(with, 0.5), run(without, 0.5);
    EXPECT_EQ(with.state_hash(), without.state_hash());
}

// A thin sheet takes exactly the speed of the wind when it is released.
TEST(Wind, carries_along_and_never_overtakes) {
    SheetDesc sheet{.rotation_degrees = {90, 0, 0}};
    sheet.fabric.body.density = 0.01f;
    World world =
        make_world({.gravity = {}, .solver = {.substeps = 2}, .air = AirDesc{.wind = {wind({0, 0, 8})}}}, sheet);
    double last = 0;
    for (int frame = 0; frame < 600; ++frame) {
        world.step(1.0 / 60);
        double mean = 0;
        for (const Vec4& v : world.frame().cloths[0].velocities) mean += v.z / 81.0;
        EXPECT_GE(mean, last - 1e-3);
        EXPECT_LE(mean, 8.001);
        last = mean;
    }
    EXPECT_GT(last, 7.9);
    EXPECT_EQ(world.frame().reports, report_none);
}

TEST(Wind, holds_a_flag_up_and_keeps_it_moving_but_whole) {
    const auto model =
        make_sheet({.size = {1.2f, 0.8f}, .resolution = {25, 17}, .rotation_degrees = {90, 0, 0}, .pinned = [](Vec3 p) {
                        return p.x < -0.59f;
                    }});
    WindDesc breeze{.velocity = {7, 0, 1.5f}, .gust = {.amplitude = 0.3f}, .turbulence = {.strength = 0.4f}};
    World world = make_world({.air = AirDesc{.wind = {breeze}}});
    world.add(model);
    run(world, 3);
    double travelled = 0, extent = 0, out_of_plane = 0;
    std::vector<Vec3> before, after;
    for (int frame = 0; frame < 120; ++frame) {
        collect_positions(world.frame(), before);
        world.step(1.0 / 60);
        collect_positions(world.frame(), after);
        travelled += mean_displacement(before, after);
        for (const Vec3 p : after) {
            extent = std::max(extent, static_cast<double>(p.x) + 0.6);
            out_of_plane = std::max(out_of_plane, static_cast<double>(std::abs(p.z)));
        }
        EXPECT_EQ(world.frame().reports, report_none);
    }
    EXPECT_GT(extent, 0.8) << "it flies";
    EXPECT_LT(extent, 1.25) << "and does not stretch";
    EXPECT_GT(out_of_plane, 0.05) << "it waves";
    EXPECT_GT(travelled / 2, 0.05) << "and goes on waving, m/s";
    EXPECT_LT(measure_strain(world.frame()).stretch.mean, 0.01);
}

TEST(Wind, of_any_strength_leaves_finite_cloth) {
    for (const float speed : {1e-6f, 100.0f, 1e4f}) {
        for (const float density : {1e-3f, 1e4f}) {
            SheetDesc sheet{.pinned = [](Vec3 p) { return p.x < -0.49f; }};
            World world = make_world({.solver = {.substeps = 4},
                                      .air = AirDesc{density,
                                                     {{.velocity = {speed, speed, 0},
                                                       .gust = {100, 1000, 1e-6f, GustPhase::scattered},
                                                       .turbulence = {100, 1e-6f, 1e-6f}},
                                                      wind({-speed, 0, speed})}}},
                                     sheet);
            run(world, 1);
            EXPECT_TRUE(all_finite(world.frame())) << speed << ' ' << density;
        }
    }
}

TEST(Wind, that_is_not_finite_is_named) {
    World world = make_world({.air = AirDesc{.wind = {wind({0, NAN, 0})}}}, SheetDesc{});
    world.step(1.0 / 60);
    EXPECT_EQ(world.frame().reports, report_non_finite);
    EXPECT_EQ(world.frame().cloths[0].detail, "a wind is not finite");
    EXPECT_TRUE(all_finite(world.frame()));
}

}  // namespace
}  // namespace weft::physical
