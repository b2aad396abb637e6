// Coarse levels: they reduce stretch and do not change the equilibrium.

#include "sheet.h"

#include <cstdio>

namespace weft::physical {
namespace {

World hung_leveled(std::uint32_t side, const WorldSettings& settings) {
    SheetDesc sheet = hung_by_corners(side, {.hierarchy = true});
    sheet.fabric.tether.use = Tethers::off;
    return make_world(settings, sheet);
}

double mean_stretch(World& world, double seconds) {
    run(world, seconds - 1);
    double sum = 0;
    for (int i = 0; i < 60; ++i) {
        world.step(1.0 / 60);
        sum += measure_strain(world.frame()).stretch.mean / 60;
    }
    return sum;
}

// Labels: slow no-asan
TEST(HierarchyOf, a_large_sheet_leaves_a_fraction_of_the_stretch) {
    for (const std::uint32_t substeps : {5u, 10u}) {
        World with = hung_leveled(64, {.solver = {.substeps = substeps, .hierarchy = true}}),
              without = hung_leveled(64, {.solver = {.substeps = substeps, .hierarchy = false}});
        const double a = mean_stretch(with, 4), b = mean_stretch(without, 4);
        std::printf("  hung 64²  %2u substeps  stretch %.2f %%, without levels %.2f %%\n", substeps, 100 * a, 100 * b);
        EXPECT_LT(a, 0.5 * b);
    }
}

// If the constraints are solved, levels have no effect: the sheet sags by the stretch of its fabric.
// Labels: slow no-asan
TEST(HierarchyOf, an_elastic_sheet_leaves_its_elasticity_alone) {
    for (const float stiffness : {300.0f, 4000.0f}) {
        SheetDesc sheet = hanging_strip({9, 33}, stiffness, 40);
        sheet.layout.hierarchy = true;
        double sags[2] = {};
        for (const bool hierarchy : {false, true}) {
            World world = make_world({.solver = {.substeps = 20, .iterations = 20, .hierarchy = hierarchy}}, sheet);
            run(world, 3);
            sags[hierarchy] = sag(world);
        }
        std::printf("  sag at %.0f N/m  %.5f m, with levels %.5f m\n", static_cast<double>(stiffness), sags[0],
                    sags[1]);
        EXPECT_NEAR(sags[1] / sags[0], 1, 0.02) << stiffness;
    }
}

// Between two corners cotton hangs a centimeter lower in the middle than rigid cloth would, since it shears.
// Labels: slow no-asan
TEST(HierarchyOf, a_sheet_that_gives_way_along_the_bias_leaves_it_hanging) {
    constexpr std::uint32_t side = 33;
    const auto hang = [](Tethers tethers, const WorldSettings& settings) {
        SheetDesc sheet = hung_by_corners(side, {.lines = true, .hierarchy = true});
        sheet.rotation_degrees = {90, 0, 0};
        sheet.fabric.body.damping = 1;
        sheet.fabric.tether.use = tethers;
        World world = make_world(settings, sheet);
        run(world, 2);
        std::vector<Vec3> places;
        collect_positions(world.frame(), places);
        return places;
    };
    const auto exact = hang(Tethers::off, {.solver = {.substeps = 100, .hierarchy = false}});
    EXPECT_LT(exact[side / 2].y, 0.495);
    EXPECT_GT(exact[side / 2].y, 0.485);
    const double plain = mean_displacement(exact, hang(Tethers::off, {.solver = {.substeps = 5, .hierarchy = false}}));
    for (const Tethers tethers : {Tethers::off, Tethers::on}) {
        const double off = mean_displacement(exact, hang(tethers, {.solver = {.substeps = 5, .hierarchy = true}}));
        std::printf("  off by %.1f mm, without levels and tethers %.1f mm\n", 1e3 * off, 1e3 * plain);
        // The remaining stretch is at the corners, where the tension is many times that elsewhere.
        EXPECT_LT(off, 0.0045);
        EXPECT_LT(off, plain / 3);
    }
}

// Taut between its pins, so that every level is active all the time. If the nodes of a level followed other particles
// than those that they move, such a sheet would vibrate at 0.2 to 0.7 m/s.
// Labels: slow no-asan
TEST(HierarchyOf, a_sheet_between_four_corners_lets_it_come_to_rest) {
    constexpr std::uint32_t side = 32;
    for (const bool rigid : {false, true}) {
        for (const std::uint32_t substeps : {5u, 20u}) {
            SheetDesc sheet{.resolution = {side, side}, .layout = {.lines = true, .hierarchy = true}};
            sheet.pinned = [](Vec3 p) { return std::abs(p.x) > 0.499f && std::abs(p.z) > 0.499f; };
            sheet.fabric.stretch.inextensible = rigid;
            World world = make_world({.solver = {.substeps = substeps, .hierarchy = true}}, sheet);
            run(world, 30);
            double fastest = 0;
            std::vector<Vec3> before, now;
            collect_positions(world.frame(), before);
            for (int frame = 0; frame < 30; ++frame) {
                world.step(1.0 / 60);
                collect_positions(world.frame(), now);
                double sum = 0;
                for (std::size_t i = 0; i < now.size(); ++i)
                    sum += 3600.0 * static_cast<double>(dot(now[i] - before[i], now[i] - before[i]));
                fastest = std::max(fastest, std::sqrt(sum / static_cast<double>(now.size())));
                before = now;
            }
            std::printf("  %2u substeps%s  %.2f mm/s\n", substeps, rigid ? ", rigid" : "", 1e3 * fastest);
            EXPECT_LT(fastest, 0.005);
        }
    }
}

// Interlock, a T-shirt fabric that its own weight stretches by a fifth. With so few substeps and no coarse levels it is
// 0.25 m too long and vibrates.
// Labels: slow no-asan
TEST(HierarchyOf, a_soft_sheet_between_four_corners_bounds_what_it_stretches_by) {
    constexpr std::uint32_t side = 65;
    const auto middle_of = [](const WorldSettings& settings) {
        SheetDesc sheet{.resolution = {side, side}, .layout = {.lines = true, .hierarchy = settings.solver.hierarchy}};
        sheet.pinned = [](Vec3 p) { return std::abs(p.x) > 0.499f && std::abs(p.z) > 0.499f; };
        sheet.fabric.body.density = 0.187f;
        sheet.fabric.stretch = {.stretch = {33, 69}, .compression = {33, 69}, .shear = 18};
        World world = make_world(settings, sheet);
        run(world, 8);
        double height = 0, fastest = 0;
        std::vector<Vec3> before, now;
        collect_positions(world.frame(), before);
        for (int frame = 0; frame < 120; ++frame) {
            world.step(1.0 / 60);
            collect_positions(world.frame(), now);
            height += static_cast<double>(now[side * side / 2].y) / 120;
            for (std::size_t i = 0; i < now.size(); ++i)
                fastest = std::max(fastest, 60.0 * static_cast<double>(length(now[i] - before[i])));
            before = now;
        }
        return std::pair{height, fastest};
    };
    const auto [exact, swing] = middle_of({.solver = {.substeps = 40, .hierarchy = false}});
    const auto [lower, wild] = middle_of({.solver = {.substeps = 5, .hierarchy = false}});
    const auto [held, calm] = middle_of({.solver = {.substeps = 5, .hierarchy = true}});
    std::printf("  middle at %.3f m, 5 substeps %.3f m, with levels %.3f m; fastest %.2f, %.2f, %.2f m/s\n", exact,
                lower, held, swing, wild, calm);
    EXPECT_LT(lower, exact - 0.1) << "what levels are for";
    EXPECT_NEAR(held, exact, 0.03);
    EXPECT_LT(calm, 0.5);
}

TEST(HierarchyOf, a_falling_sheet_does_not_disturb_its_fall) {
    World world = make_world({.solver = {.hierarchy = true}}, {.resolution = {33, 33}, .layout = {.hierarchy = true}});
    run(world, 1);
    const double h = 1.0 / 1200;
    EXPECT_NEAR(center_of_mass(world.frame().cloths[0]).y / (-0.5 * 9.81 * (1 + h)), 1, 1e-5);
}

}  // namespace
}  // namespace weft::physical
