// Tension in sheets that hang by one side, against the weight below.

#include "sheet.h"

#include "solver/measures/tension.h"

#include <array>
#include <cstdio>
#include <random>

namespace weft::physical {
namespace {

enum class HungMesh { uniform, alternating, irregular };

struct HungSheet {
    const char* name;
    const char* preset;
    bool by_weft = false;  ///< hangs along the weft instead of the warp
    HungMesh mesh = HungMesh::alternating;
    std::uint32_t side = 64;  ///< particles
};

// A square meter that hangs by its side y = 0, with its warp or weft upright.
std::shared_ptr<const ClothModel> hung_model(const HungSheet& sheet, const ClothLayout& layout) {
    const std::uint32_t n = sheet.side;
    TriangleMesh mesh =
        make_grid({1, 1}, {n, n}, sheet.mesh == HungMesh::uniform ? GridDiagonal::uniform : GridDiagonal::alternating);
    if (sheet.mesh == HungMesh::irregular) {
        std::mt19937 chance(7);
        const auto offset = [&] {
            return (static_cast<float>(chance() % 2001) / 1000 - 1) * 0.25f / static_cast<float>(n - 1);
        };
        for (std::uint32_t iz = 1; iz + 1 < n; ++iz)
            for (std::uint32_t ix = 1; ix + 1 < n; ++ix) mesh.positions[iz * n + ix] += Vec3{offset(), 0, offset()};
    }
    ClothModelDesc desc{.name = "sheet", .fabric = find_fabric(sheet.preset)->fabric, .layout = layout};
    for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
        Vec3& p = mesh.positions[v];
        const float down = (sheet.by_weft ? p.z : p.x) + 0.5f;
        if (down < 1e-3f) desc.pins.particles.push_back(v);
        p = {sheet.by_weft ? p.x : p.z, -down, 0};
    }
    if (sheet.mesh == HungMesh::irregular) {  // the warp of a triangle would follow the shifted vertices
        for (std::uint32_t v = 0; v < mesh.positions.size(); ++v)
            mesh.uvs[v] = sheet.by_weft ? Vec2{mesh.positions[v].x, -mesh.positions[v].y}
                                        : Vec2{-mesh.positions[v].y, mesh.positions[v].x};
    }
    desc.mesh = mesh;
    auto topology = build_topology(mesh, {.reorder = false});
    EXPECT_TRUE(topology.ok());
    auto model = build_cloth_model(std::move(desc), std::move(*topology));
    EXPECT_TRUE(model.ok());
    return *model;
}

// Tension over the weight below, mean over a second: soft sheets still swing up and down a little.
struct TensionFactor {
    double mean = 0;     ///< of the cloth between a tenth and nine tenths of the length
    double largest = 0;  ///< of a particle there, mean over the frames
};

TensionFactor factor_of(const ClothFrame& cloth, const StressTable& table) {
    const ClothTension measured = measure_tension(table, cloth.positions);
    double tension = 0, load = 0, largest = 0;
    for (std::uint32_t p = 0; p < cloth.model->particle_count; ++p) {
        const double below = 1 + cloth.model->rest_position(p).y;
        if (below < 0.1 || below > 0.9) continue;
        const double weight = cloth.model->fabric.body.density * 9.81 * below;
        tension += measured.tension[p] * table.area[p];
        load += weight * table.area[p];
        largest = std::max(largest, measured.tension[p] / weight);
    }
    return {tension / load, largest};
}

TensionFactor hang(const HungSheet& sheet, const SolverDesc& solver) {
    const WorldSettings settings{.solver = solver};
    World world = make_world(settings);
    const auto model = hung_model(sheet, settings.layout());
    world.add(model);
    run(world, 3);
    const StressTable table = make_stress_table(*model, model->triangles());
    TensionFactor sum;
    constexpr int frames = 60;
    for (int i = 0; i < frames; ++i) {
        world.step(1.0 / 60);
        const TensionFactor now = factor_of(world.frame().cloths[0], table);
        sum.mean += now.mean / frames, sum.largest += now.largest / frames;
    }
    return sum;
}

struct HungRow {
    HungSheet sheet;
    SolverDesc solver;
    double factor;
};

void expect_factors(std::initializer_list<HungRow> rows) {
    for (const HungRow& row : rows) {
        const TensionFactor got = hang(row.sheet, row.solver);
        std::printf("  tension over weight  %-32s %2u substeps  mean %.3f, largest %.3f\n", row.sheet.name,
                    row.solver.substeps, got.mean, got.largest);
        EXPECT_NEAR(got.mean, row.factor, 0.02 + 0.1 * std::abs(row.factor - 1))
            << row.sheet.name << ", " << row.solver.substeps << " substeps";
    }
}

// Stretch that the solver left unsolved reads as tension. On grids, lines solve warp and weft nearly exactly.
// Labels: slow no-asan long
TEST(HungTension, on_a_grid_is_the_weight_below) {
    expect_factors({{{"cotton, warp", "cotton"}, {.substeps = 20}, 1.016},
                    {{"cotton, warp", "cotton"}, {.substeps = 60}, 1.011},
                    {{"cotton, weft", "cotton", true}, {.substeps = 20}, 1.017},
                    {{"cotton, weft", "cotton", true}, {.substeps = 60}, 1.011},
                    {{"cotton, uniform", "cotton", false, HungMesh::uniform}, {.substeps = 20}, 1.016},
                    {{"denim, warp", "denim"}, {.substeps = 20}, 1.01},
                    {{"denim, weft", "denim", true}, {.substeps = 20}, 1.004},
                    {{"rubber, warp", "rubber"}, {.substeps = 20}, 1},
                    {{"rubber, warp", "rubber"}, {.substeps = 60}, 1}});
}

// Elsewhere the measure is too large, the more the stiffer and lighter the cloth: these are the factors.
// Labels: slow no-asan long
TEST(HungTension, exceeds_the_weight_below_by_what_is_unsolved) {
    constexpr Projection one_by_one = Projection::gauss_seidel;
    expect_factors(
        {{{"cotton, gauss-seidel", "cotton"}, {.substeps = 20, .projection = one_by_one, .hierarchy = false}, 69},
         {{"cotton, gauss-seidel", "cotton"}, {.substeps = 60, .projection = one_by_one, .hierarchy = false}, 9.98},
         {{"cotton, irregular", "cotton", false, HungMesh::irregular}, {.substeps = 20}, 5.33},
         {{"cotton, irregular", "cotton", false, HungMesh::irregular}, {.substeps = 60}, 1.67},
         {{"cotton, irregular, 32 x 32", "cotton", false, HungMesh::irregular, 32}, {.substeps = 20}, 2.27},
         {{"rubber, irregular", "rubber", false, HungMesh::irregular}, {.substeps = 20}, 1.13},
         {{"rubber, irregular", "rubber", false, HungMesh::irregular}, {.substeps = 60}, 1.02}});
}

// Positions are read back from the device; the measure has no part on it.
TEST(TensionOf, a_cloth_does_not_depend_on_the_backend) {
    const SheetDesc sheet = hung_by_corners(9, {});
    World world = make_world({.solver = {.substeps = 4}}, sheet);
    World cpu = make_world({.solver = {.substeps = 4}}, sheet, CpuOptions{});
    run(world, 0.2), run(cpu, 0.2);
    const TensionSummary here = TensionMeter().measure(world.frame()), there = TensionMeter().measure(cpu.frame());
    const double most = there.most.value().value;
    EXPECT_GT(most, 10);
    EXPECT_NEAR(here.most.value().value, most, 1e-3 * most);
    EXPECT_NEAR(here.mean.value(), there.mean.value(), 1e-3 * there.mean.value());
    EXPECT_NEAR(here.load.value().value, there.load.value().value, 1e-3 * there.load->value);
    EXPECT_EQ(here.most->at.particle, there.most->at.particle);
}

}  // namespace
}  // namespace weft::physical
