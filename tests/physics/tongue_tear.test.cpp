// The tongue (trouser) tear: a strip is cut in from the middle of a short side, and both tongues are pulled apart out
// of its plane.

#include "sheet.h"

#include "solver/measures/pieces.h"
#include "solver/measures/tension.h"
#include "solver/model/cuts.h"

#include <cmath>
#include <cstdio>

namespace weft::physical {
namespace {

constexpr float tongue_length = 0.2f, tongue_width = 0.1f, tongue_cut = 0.05f;  // m; the cut is along x

struct TongueDesc {
    std::uint32_t cells = 8;  // across the width, even
    std::uint32_t substeps = 20;
    float jitter = 0;  // in cells
    const char* fabric = "rubber";
    double speed = 0.02;  // m/s, of each clamp
    float damping = 0.02f;
};

struct TongueTear {
    double expected = 0;  // N
    double first = 0;     // N, of a tongue: when the rip first grows
    double most = 0;      // N, of a tongue, in any frame
    double advance = 0;   // m
    double farthest = 0;  // edges from the middle line
    bool parted = false;  // a tongue was torn off
};

std::shared_ptr<const ClothModel> make_tongues(const TongueDesc& desc, const Fabric& fabric) {
    TriangleMesh mesh =
        make_grid({tongue_length, tongue_width}, {2 * desc.cells + 1, desc.cells + 1}, GridDiagonal::alternating);
    const float cell = tongue_width / static_cast<float>(desc.cells);
    std::uint32_t state = 4711;
    const auto random = [&] {
        state = state * 1664525u + 1013904223u;
        return static_cast<float>(state >> 8) / 8388608.0f - 1;
    };
    for (Vec3& x : mesh.positions) {
        const float dx = random() * desc.jitter * cell, dz = random() * desc.jitter * cell;
        // The border keeps its shape, and the cut starts straight.
        const bool inner = std::abs(x.x) < 0.499f * tongue_length && std::abs(x.z) < 0.499f * tongue_width &&
                           !(std::abs(x.z) < 0.01f * cell && x.x < tongue_cut - 0.499f * tongue_length);
        x = {x.x + (inner ? dx : 0), x.z + (inner ? dz : 0), 0};
        x.y = -x.y;
    }
    ClothModelDesc model{.name = "tongues",
                         .fabric = fabric,
                         .layout = {.lines = true, .hierarchy = true},
                         .reserve = {.particles = 4 * desc.cells + 64, .openings = true, .tears = true}};
    for (std::uint32_t p = 0; p < mesh.positions.size(); ++p) {
        const Vec3 x = mesh.positions[p];
        if (x.x < -0.499f * tongue_length && std::abs(x.y) > 0.01f * cell) model.pins.particles.push_back(p);
    }
    auto topology = build_topology(mesh, {.reorder = false});
    model.mesh = std::move(mesh);
    auto built = build_cloth_model(std::move(model), std::move(*topology));
    EXPECT_TRUE(built.ok());
    return *built;
}

// The clamps pull by F. While the rip grows by dx, each tongue grows by dx, its end moves by (1 + ε) dx, and a piece dx
// of it stretches to ε: 2 F (1 + ε) = Γ + K ε² w with F = K ε w and the width w of a tongue, so 2 F + F²/(K w) = Γ.
double tongue_force(const Fabric& fabric) {
    const double w = double{tongue_width} / 2, k = double{fabric.stretch.stretch[0]};
    return k * w * (std::sqrt(1 + double{fabric.tear.tear_energy} / (k * w)) - 1);
}

// N/m: mean tension between 1 and 4 cm from the clamps. The tongues are free at their sides, so it is along them.
double tongue_tension(const ClothFrame& cloth) {
    const StressTable table = make_stress_table(*cloth.model, cloth.triangles);
    const ClothTension measured = measure_tension(table, cloth.positions);
    double sum = 0, area = 0;
    for (std::uint32_t p = 0; p < cloth.model->particle_count; ++p) {
        const double x = double{cloth.model->rest_position(p).x} + 0.5 * double{tongue_length};
        if (x < 0.01 || x > 0.04) continue;
        sum += table.area[p] * measured.tension[p], area += table.area[p];
    }
    return sum / area;
}

TongueTear tear_tongues(const TongueDesc& desc) {
    Fabric fabric = find_fabric(desc.fabric)->fabric;
    fabric.body.damping = desc.damping;
    const auto model = make_tongues(desc, fabric);
    KinematicTargets targets;
    const auto far = static_cast<float>(100 * desc.speed);
    for (const float way : {-1.0f, 1.0f}) targets.motions.push_back({.offsets = {{0, {}}, {100, {0, 0, way * far}}}});
    for (std::uint32_t p = 0; p < model->particle_count; ++p) {
        const Vec3 x = model->rest_position(p);
        if (!(x.x < -0.499f * tongue_length) || std::abs(x.y) < 1e-3f * tongue_width) continue;
        targets.particles.push_back({p, x.y > 0 ? 1u : 0u, x});
    }
    World world = make_world({.gravity = {}, .solver = {.substeps = desc.substeps, .projection = Projection::lines}});
    const ClothId id = world.add(model, targets);
    const std::vector<Vec3> stroke{{-0.51f * tongue_length, 0, 0}, {tongue_cut - 0.5f * tongue_length, 0, 0}};
    EXPECT_TRUE(world.edit(id, {.openings = openings_along_stroke(*model, model->start, stroke)}).ok());
    const std::size_t cut = world.model(id)->copied_from.size();

    TongueTear result{.expected = tongue_force(fabric)};
    while (world.time() < 0.3 / desc.speed && !result.parted && result.advance < 0.1) {
        const double force = tongue_tension(world.frame().cloths[0]) * double{tongue_width} / 2;
        result.most = std::max(result.most, force);
        world.step(1.0 / 60);
        const ClothModel& now = *world.frame().cloths[0].model;
        if (result.first == 0 && now.copied_from.size() > cut) result.first = force;
        double end = double{tongue_cut} - 0.5 * double{tongue_length};
        for (std::size_t i = cut; i < now.copied_from.size(); ++i)
            end = std::max(end, double{now.rest_position(now.copied_from[i]).x});
        result.advance = end + 0.5 * double{tongue_length} - double{tongue_cut};
        result.parted = find_pieces(world.frame()).count > 1;
    }
    const ClothModel& torn = *world.frame().cloths[0].model;
    for (std::size_t i = cut; i < torn.copied_from.size(); ++i)
        result.farthest = std::max(result.farthest, std::abs(double{torn.rest_position(torn.copied_from[i]).y}) *
                                                        desc.cells / double{tongue_width});
    return result;
}

void print(const TongueDesc& desc, const TongueTear& tear) {
    std::printf(
        "  %s, %2u cells, %2u substeps, jitter %.2f: force %.3f N at first, at most %.3f, expected %.3f, ratio %.2f; "
        "the rip grew by %.3f m, within %.2f edges of its line%s\n",
        desc.fabric, desc.cells, desc.substeps, static_cast<double>(desc.jitter), tear.first, tear.most, tear.expected,
        tear.first / tear.expected, tear.advance, tear.farthest, tear.parted ? "; a tongue was torn off" : "");
    std::fflush(stdout);
}

// The figures of docs/physical-tests.md.
TEST(TongueTear, DISABLED_measures_all) {
    for (const char* fabric : {"rubber", "denim", "cotton"}) {
        for (const TongueDesc& desc : {TongueDesc{.cells = 8, .substeps = 80, .fabric = fabric},
                                       TongueDesc{.cells = 16, .substeps = 80, .fabric = fabric},
                                       TongueDesc{.cells = 32, .substeps = 80, .fabric = fabric},
                                       TongueDesc{.cells = 16, .substeps = 80, .jitter = 0.25f, .fabric = fabric}})
            print(desc, tear_tongues(desc));
    }
}

// Known error: the limit at the end of a cut is one of tension in the plane of the cloth. Here the tongues are folded
// away from the end, and their tension along the cut counts instead of the force that parts them.
// Labels: slow no-asan
TEST(TongueTear, needs_several_times_half_of_the_tear_energy) {
    for (const TongueDesc& desc : {TongueDesc{.cells = 8, .substeps = 80}, TongueDesc{.cells = 16, .substeps = 80}}) {
        const TongueTear tear = tear_tongues(desc);
        print(desc, tear);
        EXPECT_GT(tear.first, 0.9 * tear.expected);
        EXPECT_LT(tear.first, 6.5 * tear.expected);
    }
}

}  // namespace
}  // namespace weft::physical
