// Lines: what they must bring, and what they must not change.

#include "sheet.h"

#include <cstdio>

namespace weft::physical {
namespace {

World hung(std::uint32_t side, WorldSettings settings, GridDiagonal diagonal, const CpuOptions& options = {}) {
    TriangleMesh mesh = make_grid({1, 1}, {side, side}, diagonal);
    for (Vec3& p : mesh.positions) p = {p.x, -0.995f * p.z, 0.1f * p.z};
    auto topology = build_topology(mesh, {.reorder = false});
    Fabric fabric;
    fabric.body.density = 0.2f;
    World world = make_world(settings, options);
    world.add(*build_cloth_model(
        {.mesh = std::move(mesh), .fabric = fabric, .pins = {.particles = {0, side - 1}}, .layout = settings.layout()},
        std::move(*topology)));
    return world;
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

TEST(LinesOf, a_hung_sheet_leave_a_fraction_of_the_error) {
    for (const GridDiagonal diagonal : {GridDiagonal::uniform, GridDiagonal::alternating}) {
        const auto error = [&](Projection projection, std::uint32_t substeps, bool hierarchy) {
            return residual_after(
                hung(64, {.substeps = substeps, .projection = projection, .hierarchy = hierarchy}, diagonal), 4);
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

// Solved or not solved by lines, the sheet hangs as far as its fabric lets it: ρ g L²/2K (docs/validation.md).
TEST(LinesOf, an_elastic_sheet_carry_its_weight) {
    SheetDesc sheet{.size = {0.25f, 1},
                    .resolution = {9, 33},
                    .rotation_degrees = {90, 0, 0},
                    .position = {0, -0.5f, 0},
                    .pinned = [](Vec3 p) { return p.z < -0.49f; }};
    sheet.fabric.body = {.density = 0.2f, .damping = 0.2f};
    sheet.fabric.stretch = {.stretch = {300, 300}, .compression = {300, 300}, .shear = 40};
    double sag[2] = {};
    for (const Projection projection : {Projection::gauss_seidel, Projection::lines}) {
        const WorldSettings settings{.substeps = 20, .iterations = 20, .projection = projection};
        TriangleMesh mesh = make_grid(sheet.size, sheet.resolution, sheet.diagonal);
        const Mat3 turn = rotation_from_degrees(sheet.rotation_degrees);
        ClothModelDesc desc{.fabric = sheet.fabric, .layout = settings.layout()};
        for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
            if (sheet.pinned(mesh.positions[v])) desc.pins.particles.push_back(v);
            mesh.positions[v] = turn * mesh.positions[v] + sheet.position;
        }
        auto topology = build_topology(mesh, {.reorder = false});
        desc.mesh = std::move(mesh);
        World world = make_world(settings);
        world.add(*build_cloth_model(std::move(desc), std::move(*topology)));
        run(world, 3);
        double lowest = 0;
        for (const Vec4& p : world.frame().cloths[0].positions) lowest = std::min(lowest, double{p.y});
        sag[projection == Projection::lines] = -1 - lowest;
    }
    const double law = 0.2 * 9.81 / (2 * 300);
    std::printf("  sag by rows %.5f m, by lines %.5f m, by the law %.5f m\n", sag[0], sag[1], law);
    EXPECT_NEAR(sag[1] / sag[0], 1, 0.01);
    EXPECT_NEAR(sag[1] / law, 1, 0.03);
}

TEST(LinesOf, a_falling_sheet_do_not_disturb_its_fall) {
    TriangleMesh mesh = make_grid({1, 1}, {33, 33}, GridDiagonal::alternating);
    auto topology = build_topology(mesh, {.reorder = false});
    World world = make_world({});
    world.add(*build_cloth_model({.mesh = std::move(mesh), .layout = world.settings().layout()}, std::move(*topology)));
    run(world, 1);
    const double h = 1.0 / 1200;
    EXPECT_NEAR(center_of_mass(world.frame().cloths[0]).y / (-0.5 * 9.81 * (1 + h)), 1, 1e-5);
}

// Short steps turn what rounding leaves of lengths into speed; nothing may feed on that.
TEST(LinesOf, a_flat_sheet_keep_it_flat_in_the_shortest_steps) {
    TriangleMesh mesh = make_grid({1, 1}, {64, 64}, GridDiagonal::alternating);
    auto topology = build_topology(mesh, {.reorder = false});
    World world = make_world({.substeps = 200, .hierarchy = true});
    world.add(*build_cloth_model({.mesh = std::move(mesh), .layout = world.settings().layout()}, std::move(*topology)));
    run(world, 0.2);
    const auto& positions = world.frame().cloths[0].positions;
    float low = positions[0].y, high = low;
    for (const Vec4& p : positions) low = std::min(low, p.y), high = std::max(high, p.y);
    EXPECT_LT(high - low, 1e-5f);
    EXPECT_LT(measure_strain(world.frame()).stretch.max, 1e-4);
}

TEST(LinesOf, a_sheet_have_the_same_bits_on_every_thread_count_and_instruction_set) {
    for (const std::uint32_t iterations : {1u, 3u}) {
        std::string first;
        for (const std::string_view isa : cpu_instruction_sets()) {
            for (const unsigned workers : {0u, 1u, 3u}) {
                World world = hung(40, {.substeps = 3, .iterations = iterations, .hierarchy = true},
                                   GridDiagonal::alternating, {.workers = workers, .isa = std::string(isa)});
                run(world, 0.3);
                if (first.empty()) first = world.state_hash();
                EXPECT_EQ(world.state_hash(), first) << isa << ' ' << workers;
            }
        }
    }
}

// Rows laid out along lines serve the other projections too, as before a change of settings builds new ones.
TEST(LinesOf, a_model_serve_every_projection) {
    for (const Projection projection : {Projection::gauss_seidel, Projection::jacobi}) {
        World lines = hung(24, {.substeps = 10}, GridDiagonal::alternating);
        lines.configure({.substeps = 10, .projection = projection});
        run(lines, 1);
        World rows = hung(24, {.substeps = 10, .projection = projection}, GridDiagonal::alternating);
        run(rows, 1);
        EXPECT_NEAR(measure_strain(lines.frame()).stretch.mean, measure_strain(rows.frame()).stretch.mean,
                    0.5 * measure_strain(rows.frame()).stretch.mean);
    }
}

}  // namespace
}  // namespace weft::physical
