// Equilibria that must not depend on the time step.

#include "specimen.h"

#include <cstdio>

namespace weft::physical {
namespace {

struct Hanging {
    double sag = 0;     ///< m: how far the lower edge sinks below its place at rest
    double energy = 0;  ///< J: held in the stretch rows
};

/// A compliant sheet, 1 m long, hung by its upper edge until it rests.
Hanging hang(float stiffness, double dt, std::uint32_t substeps, std::uint32_t iterations,
             Compensation compensation = Compensation::automatic) {
    constexpr std::uint32_t nx = 5, nz = 17;
    Fabric fabric;
    fabric.body = {.density = 0.2f, .damping = 0};
    fabric.stretch = {.stretch = {stiffness, stiffness}, .compression = {stiffness, stiffness}, .shear = 0};
    fabric.bend = {.bend = {0, 0, 0}};
    Specimen cloth(make_sheet({.size = {0.25f, 1},
                               .resolution = {nx, nz},
                               .rotation_degrees = {90, 0, 0},
                               .position = {0, -0.5f, 0},
                               .fabric = fabric,
                               .pinned = [](Vec3 p) { return p.z < -0.49f; }}),
                   {.dt = dt, .substeps = substeps, .iterations = iterations, .compensation = compensation});
    // The lowest frequency is that of a spring under its own mass, (π/2) √(K/ρ_A)/L.
    const double frequency = 1.5708 * std::sqrt(stiffness / 0.2);
    cloth.settle(std::min(2 * frequency, 1 / dt), 1e-5, 2);
    EXPECT_EQ(cloth.reports(), report_none);
    Hanging result;
    for (std::uint32_t ix = 0; ix < nx; ++ix) result.sag += (-1 - cloth.position((nz - 1) * nx + ix).y) / double{nx};
    result.energy = measure_energy(cloth).stretch;
    return result;
}

void expect_same_sag(std::uint32_t substeps, std::uint32_t iterations) {
    constexpr float stiffness = 60;
    const double law = 0.2 * Specimen::gravity / (2 * stiffness);  // ρ_A g L²/(2K)
    for (const double rate : {60.0, 240.0, 960.0}) {
        const double sag = hang(stiffness, 1 / rate, substeps, iterations).sag;
        std::printf("  time step  1/%3.0f s, %2u x %2u  sag %.6f m, %+.3f %%\n", rate, substeps, iterations, sag,
                    100 * (sag / law - 1));
        EXPECT_NEAR(sag / law, 1, 0.01) << rate << " Hz";
    }
}

// Position-based dynamics fails this test: its stiffness depends on the number of projections.
TEST(TimeStep, does_not_decide_how_far_a_sheet_stretches) {
    expect_same_sag(2, 40);
}

// In 1/19200 s gravity moves a particle by 2.6e-8 m, half the spacing of floats near 1 m. Projections keep what
// rounding drops from displacements that small.
TEST(TimeStep, does_not_matter_when_it_is_very_short_either) {
    expect_same_sag(20, 4);
}

TEST(TimeStep, matters_when_it_is_very_short_and_projections_drop_what_rounding_drops) {
    EXPECT_GT(hang(60, 1.0 / 960, 20, 4, Compensation::off).sag, 1.1 * hang(60, 1.0 / 960, 20, 4).sag);
}

TEST(TimeStep, leaves_the_energy_that_the_load_put_in) {
    // Each spring holds half of what the weight below has done: ½ ∫ (ρ_A g (L − s))²/K ds per width = ρ_A² g² L³/(6K).
    constexpr double stiffness = 60, load = 0.2 * Specimen::gravity;
    const double law = 0.25 * load * load / (6 * stiffness);
    const double energy = hang(stiffness, 1.0 / 240, 2, 40).energy;
    std::printf("  energy of stretch  %.4e J, %+.2f %%\n", energy, 100 * (energy / law - 1));
    EXPECT_NEAR(energy / law, 1, 0.01);
}

/// A sheet hangs by the two ends of one side. Largest distance of a particle from the mirror image of its partner after
/// a second and a half of coming to rest, over the side of 1 m. `by_x`: hung by the side z < 0, mirrored in x;
/// otherwise the other way round.
double asymmetry(GridDiagonal diagonal, bool by_x, std::uint32_t substeps, std::uint32_t iterations) {
    constexpr std::uint32_t n = 9;  // an even number of cells: alternating diagonals then mirror each other
    const auto model = make_sheet(
        {.resolution = {n, n},
         .diagonal = diagonal,
         .rotation_degrees = by_x ? Vec3{90, 0, 0} : Vec3{0, 0, -90},
         .pinned = [=](Vec3 p) { return (by_x ? p.z : p.x) < -0.49f && std::abs(by_x ? p.x : p.z) > 0.49f; }});
    Specimen cloth(model, {.dt = 1.0 / 60, .substeps = substeps, .iterations = iterations});
    cloth.settle(4, 0, 1.5);
    EXPECT_EQ(cloth.reports(), report_none);
    double worst = 0;
    const auto compare = [&](std::uint32_t first, std::uint32_t side) {
        for (std::uint32_t iz = 0; iz < side; ++iz) {
            for (std::uint32_t ix = 0; ix < side; ++ix) {
                const std::uint32_t partner = first + (by_x ? iz * side + side - 1 - ix : (side - 1 - iz) * side + ix);
                Vec3 a = cloth.position(first + iz * side + ix);
                (by_x ? a.x : a.z) *= -1;
                worst = std::max<double>(worst, length(a - cloth.position(partner)));
            }
        }
    };
    compare(0, n);
    if (diagonal == GridDiagonal::cross) compare(n * n, n - 1);
    std::printf("  symmetry  %-12s in %s  %2u x %2u  %.1e of its side\n",
                diagonal == GridDiagonal::cross ? "cross" : "alternating", by_x ? "x" : "z", substeps, iterations,
                worst);
    return worst;
}

// Constraints are projected one color after another, and the mirror image of a constraint may have another color. The
// effect is no larger than the residual.
// Labels: slow no-asan
TEST(Symmetry, a_sheet_hung_by_two_corners_is_its_own_mirror_image) {
    for (const GridDiagonal diagonal : {GridDiagonal::alternating, GridDiagonal::cross}) {
        for (const bool by_x : {true, false}) {
            EXPECT_LT(asymmetry(diagonal, by_x, 20, 1), 2e-3);
            EXPECT_LT(asymmetry(diagonal, by_x, 10, 20), 1e-4);
        }
    }
}

}  // namespace
}  // namespace weft::physical
