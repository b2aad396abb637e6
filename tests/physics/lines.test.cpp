// Lines: they reduce stretch and do not change the equilibrium.

#include "sheet.h"

#include <cstdio>

namespace weft::physical {
namespace {

World hung_sheet(std::uint32_t side, const WorldSettings& settings, GridDiagonal diagonal) {
    SheetDesc sheet = hung_by_corners(side, settings.layout());
    sheet.diagonal = diagonal;
    sheet.fabric.body.density = 0.2f;
    return make_world(settings, sheet);
}

double residual_after(World world, double seconds) {
    run(world, seconds - 1);
    double sum = 0;
    for (int i = 0; i < 60; ++i) {
        world.step(1.0 / 60);
        sum += world.stretch_residual().mean / 60;
    }
    return sum;
}

// Labels: slow no-asan
TEST(LinesOf, a_hung_sheet_leave_a_fraction_of_the_error) {
    for (const GridDiagonal diagonal : {GridDiagonal::uniform, GridDiagonal::alternating}) {
        const auto error = [&](Projection projection, std::uint32_t substeps, bool hierarchy) {
            return residual_after(
                hung_sheet(64, {.solver = {.substeps = substeps, .projection = projection, .hierarchy = hierarchy}},
                           diagonal),
                4);
        };
        const double rows = error(Projection::gauss_seidel, 20, false), lines = error(Projection::lines, 20, false),
                     all = error(Projection::lines, 5, true), few = error(Projection::gauss_seidel, 5, false);
        std::printf(
            "  hung 64²  20 substeps: rows %.2f %%, lines %.2f %%;  5 substeps: rows %.2f %%, lines and levels %.2f "
            "%%\n",
            100 * rows, 100 * lines, 100 * few, 100 * all);
        EXPECT_LT(lines, 0.5 * rows);
        EXPECT_LT(all, 0.2 * few);
    }
}

// With lines and without, the sheet sags by the stretch of its fabric: ρ g L²/2K.
// Labels: slow no-asan
TEST(LinesOf, an_elastic_sheet_carry_its_weight) {
    SheetDesc sheet = hanging_strip({9, 33}, 300, 40);
    double sags[2] = {};
    for (const Projection projection : {Projection::gauss_seidel, Projection::lines}) {
        const WorldSettings settings{
            .solver = {.substeps = 20, .iterations = 20, .projection = projection, .hierarchy = false}};
        sheet.layout = settings.layout();
        World world = make_world(settings, sheet);
        run(world, 3);
        sags[projection == Projection::lines] = sag(world);
    }
    const double law = 0.2 * 9.81 / (2 * 300);
    std::printf("  sag by rows %.5f m, by lines %.5f m, by the law %.5f m\n", sags[0], sags[1], law);
    EXPECT_NEAR(sags[1] / sags[0], 1, 0.01);
    EXPECT_NEAR(sags[1] / law, 1, 0.03);
}

// Two edges are held 2 % too far apart: no shape of rigid cloth fits; cotton becomes flat.
double fastest_when_taut(const Fabric& fabric, double& mean_stretch) {
    const WorldSettings settings{.solver = {.substeps = 20, .hierarchy = true}};
    const auto at_edge = [](Vec3 p) { return std::abs(p.x) > 0.49f; };
    const auto model =
        make_sheet({.resolution = {64, 64}, .fabric = fabric, .layout = settings.layout(), .pinned = at_edge});
    KinematicTargets targets{
        .motions = {{.offsets = {{0, {}}, {1, {-0.01f, 0, 0}}}}, {.offsets = {{0, {}}, {1, {0.01f, 0, 0}}}}},
        .particles = {}};
    for (std::uint32_t p = 0; p < model->particle_count; ++p) {
        const Vec4 start = model->start[p];
        if (start.w == 0) targets.particles.push_back({p, start.x < 0 ? 0u : 1u, start.xyz()});
    }
    World world = make_world(settings);
    world.add(model, std::move(targets));
    run(world, 3);
    double fastest = 0;
    for (int i = 0; i < 30; ++i) {
        world.step(1.0 / 60);
        for (const Vec4& v : world.frame().cloths[0].velocities) fastest = std::max(fastest, double{length(v.xyz())});
    }
    mean_stretch = measure_strain(world.frame()).stretch.mean;
    return fastest;
}

// Labels: slow no-asan
TEST(LinesOf, a_sheet_held_too_far_apart_do_not_crumple_it) {
    Fabric rigid;
    rigid.stretch.inextensible = true;
    double cotton_stretch = 0, rigid_stretch = 0;
    const double cotton = fastest_when_taut({}, cotton_stretch), hard = fastest_when_taut(rigid, rigid_stretch);
    std::printf("  held 2 %% too far apart: cotton %.2f %% at %.3f m/s, rigid %.2f %% at %.3f m/s\n",
                100 * cotton_stretch, cotton, 100 * rigid_stretch, hard);
    EXPECT_LT(cotton_stretch, 0.012) << "2 % along a third of the edges, half of that along the diagonals";
    EXPECT_LT(cotton, 1);
    EXPECT_LT(rigid_stretch, 0.04);
}

TEST(LinesOf, a_falling_sheet_do_not_disturb_its_fall) {
    World world =
        make_world({.solver = {.projection = Projection::lines}}, {.resolution = {33, 33}, .layout = {.lines = true}});
    run(world, 1);
    const double h = 1.0 / 1200;
    EXPECT_NEAR(center_of_mass(world.frame().cloths[0]).y / (-0.5 * 9.81 * (1 + h)), 1, 1e-5);
}

// With short substeps, rounding errors of lengths become velocities. They must not grow.
// Labels: slow no-asan
TEST(LinesOf, a_flat_sheet_keep_it_flat_in_the_shortest_steps) {
    World world = make_world({.solver = {.substeps = 200, .projection = Projection::lines, .hierarchy = true}},
                             {.resolution = {64, 64}, .layout = {.lines = true, .hierarchy = true}});
    run(world, 0.2);
    const auto& positions = world.frame().cloths[0].positions;
    float low = positions[0].y, high = low;
    for (const Vec4& p : positions) low = std::min(low, p.y), high = std::max(high, p.y);
    EXPECT_LT(high - low, 1e-5f);
    EXPECT_LT(measure_strain(world.frame()).stretch.max, 1e-4);
}

// The other projections can use constraints that are stored along lines, until a change of settings rebuilds them.
TEST(LinesOf, a_model_serve_every_projection) {
    for (const Projection projection : {Projection::gauss_seidel, Projection::jacobi}) {
        World lines = hung_sheet(24, {.solver = {.substeps = 10, .hierarchy = false}}, GridDiagonal::alternating);
        lines.configure({.solver = {.substeps = 10, .projection = projection, .hierarchy = false}});
        run(lines, 1);
        World rows = hung_sheet(24, {.solver = {.substeps = 10, .projection = projection, .hierarchy = false}},
                                GridDiagonal::alternating);
        run(rows, 1);
        EXPECT_NEAR(measure_strain(lines.frame()).stretch.mean, measure_strain(rows.frame()).stretch.mean,
                    0.5 * measure_strain(rows.frame()).stretch.mean);
    }
}

}  // namespace
}  // namespace weft::physical
