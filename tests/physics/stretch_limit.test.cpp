// Cloth that becomes stiff at a strain, as knits do.

#include "sheet.h"

#include "solver/measures/tension.h"

#include <cstdio>

namespace weft::physical {
namespace {

constexpr double stiffness = 100, limit = 0.2, gravity = 9.81, density = 5;

// Strain under a tension, N/m: the stiffness grows to 50 times from half of the limit to one and a half times it.
double strain_under(double tension) {
    const auto tension_at = [](double strain) {
        const double from = strain - limit / 2;
        const double more = from < 0 ? 0 : from < limit ? from * from / (2 * limit) : from - limit / 2;
        return stiffness * (strain + 49 * more);
    };
    double low = 0, high = 1;
    for (int i = 0; i < 60; ++i) {
        const double middle = (low + high) / 2;
        (tension_at(middle) < tension ? low : high) = middle;
    }
    return low;
}

// Sag of a strip of 1 m that hangs by its upper edge, under the weight of what is below each point.
double expected_sag() {
    constexpr int parts = 2000;
    double sum = 0;
    for (int i = 0; i < parts; ++i) sum += strain_under(density * gravity * (i + 0.5) / parts) / parts;
    return sum;
}

SheetDesc heavy_strip(StretchModel model, std::array<std::uint32_t, 2> resolution) {
    SheetDesc sheet = hanging_strip(resolution, stiffness, 5);
    sheet.fabric.body.density = density;
    sheet.fabric.stretch.stretch_limit[0] = sheet.fabric.stretch.stretch_limit[1] = limit;
    sheet.fabric.stretch.model = model;
    sheet.layout = {.lines = true, .hierarchy = true};
    return sheet;
}

// Without a limit the strip would sag by 0.25 m.
// Labels: slow no-asan
TEST(StretchLimit, of_a_hanging_strip_bounds_its_sag) {
    for (const StretchModel model : {StretchModel::edges, StretchModel::membrane}) {
        for (const std::uint32_t cells : {16u, 32u}) {
            World world = make_world({.solver = {.substeps = 20}}, heavy_strip(model, {cells / 4 + 1, cells + 1}));
            run(world, 12);
            std::printf("  %s, %u cells: sag %.4f m, expected %.4f m\n",
                        model == StretchModel::edges ? "edges" : "membrane", cells, sag(world), expected_sag());
            EXPECT_NEAR(sag(world), expected_sag(), 0.02 * expected_sag());
        }
    }
}

// Labels: slow no-asan
TEST(StretchLimit, leaves_the_tension_that_of_the_weight_below) {
    World world = make_world({.solver = {.substeps = 40}}, heavy_strip(StretchModel::edges, {9, 33}));
    run(world, 12);
    const ClothModel& model = *world.frame().cloths[0].model;
    const ClothTension measured =
        measure_tension(make_stress_table(model, model.triangles()), world.frame().cloths[0].positions);
    for (std::uint32_t p = 0; p < model.particle_count; ++p) {
        const double below = 1 + model.start[p].y;  // the strip reaches from y = -1 to 0
        if (below < 0.15 || below > 0.85 || std::abs(model.start[p].x) > 0.1f) continue;
        EXPECT_NEAR(measured.tension[p], below * density * gravity, 0.08 * below * density * gravity) << below;
    }
}

TEST(StretchLimit, changes_while_the_cloth_hangs) {
    const auto model = make_sheet(heavy_strip(StretchModel::edges, {5, 17}));
    World world = make_world({.solver = {.substeps = 20}});
    world.add(model);
    run(world, 10);
    const double before = sag(world);
    Fabric fabric = model->fabric;
    fabric.stretch.stretch_limit[0] = fabric.stretch.stretch_limit[1] = 0;
    ASSERT_TRUE(set_fabric(world, world.cloth_id(0), fabric).ok());
    run(world, 10);
    EXPECT_NEAR(sag(world), density * gravity / (2 * stiffness), 0.03 * sag(world)) << "no limit";
    ASSERT_TRUE(set_fabric(world, world.cloth_id(0), model->fabric).ok());
    run(world, 10);
    EXPECT_NEAR(sag(world), before, 0.01 * before);
}

TEST(StretchLimit, changes_no_bit_of_cloth_that_does_not_reach_it) {
    const auto hash_with = [](float strain) {
        SheetDesc sheet = hung_by_corners(17, {.lines = true, .hierarchy = true});
        sheet.fabric.stretch.stretch_limit[0] = sheet.fabric.stretch.stretch_limit[1] = strain;
        World world = make_world({.solver = {.substeps = 20}}, sheet);
        run(world, 1);
        return world.state_hash();
    };
    EXPECT_EQ(hash_with(0), hash_with(5));
    EXPECT_NE(hash_with(0), hash_with(0.001f));
}

}  // namespace
}  // namespace weft::physical
