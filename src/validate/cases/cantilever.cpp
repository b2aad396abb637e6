// A heavy strip that is clamped at one end (protocol of Romero et al. 2021, "Physical Validation of Simulators in
// Computer Graphics: A New Framework Dedicated to Slender Elastic Structures and Frictional Contact").
#include "validate/sheets.h"
#include "validate/strip_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <span>

namespace weft {

using namespace cases;
namespace {

constexpr double strip_density = 0.2;

// Drop over reach of the tip of an inextensible heavy elastica that leaves its clamp horizontally, for
// gamma = rho_A g L³/B. d²θ/ds² = −gamma (1 − s) cos θ, θ(0) = 0, θ'(1) = 0, by shooting with Runge-Kutta steps.
double elastica(double gamma) {
    struct State {
        double angle = 0, curvature = 0, x = 0, y = 0;
    };
    const auto tip_of = [&](double curvature) {
        constexpr int steps = 4000;
        constexpr double h = 1.0 / steps;
        const auto rate = [&](const State& s, double at) {
            return State{s.curvature, -gamma * (1 - at) * std::cos(s.angle), std::cos(s.angle), std::sin(s.angle)};
        };
        const auto moved = [](const State& s, const State& by, double t) {
            return State{s.angle + t * by.angle, s.curvature + t * by.curvature, s.x + t * by.x, s.y + t * by.y};
        };
        State s{0, curvature, 0, 0};
        for (int i = 0; i < steps; ++i) {
            const double at = i * h;
            const State a = rate(s, at), b = rate(moved(s, a, h / 2), at + h / 2),
                        c = rate(moved(s, b, h / 2), at + h / 2), d = rate(moved(s, c, h), at + h);
            s = moved(moved(moved(moved(s, a, h / 6), b, h / 3), c, h / 3), d, h / 6);
        }
        return s;
    };
    // The angle is measured downward; the curvature at the clamp lies between none and that of the straight strip.
    double low = 0, high = gamma;
    for (int i = 0; i < 80; ++i) {
        const double middle = 0.5 * (low + high);
        (tip_of(middle).curvature < 0 ? low : high) = middle;
    }
    const State tip = tip_of(0.5 * (low + high));
    return tip.y / tip.x;
}

struct StripOf {
    const char* name;
    Cut cut;
    GridDiagonal diagonal;
};

struct Bending {
    const char* name;
    BendModel model;
};
constexpr Bending moment{"moment", BendModel::moment}, plate{"plate", BendModel::plate},
    dihedral{"dihedral", BendModel::dihedral};

struct Settings {
    double gamma;
    std::uint32_t cells;
    double h;  ///< s, short enough that bending is solved
    std::uint32_t iterations;
};

// Two rows of particles are pinned. The free length begins where the sheet begins to bend.
double drop_over_reach(const Validation& validation, const StripOf& of, std::uint32_t across, const Bending& bending,
                       const Settings& settings) {
    StripMesh strip = make_strip(of.cut, of.diagonal, settings.cells, across);
    // Triangles that are pinned by all corners are rigid to moments.
    double root = strip.root;
    if (bending.model == BendModel::moment)
        for (const Vec3 p : strip.mesh.positions)
            if (strip.along(p) < strip.clamp) root = std::max(root, strip.along(p));
    // With diagonals along the strip the clamp ends in a zigzag line half a cell deep. This is its mean.
    if (bending.model == BendModel::moment && of.cut == Cut::bias_along) root -= 0.25 / (settings.cells - 0.5);
    const double length = strip.tip - root;
    const auto b = static_cast<float>(strip_density * standard_gravity * length * length * length / settings.gamma);
    // A strain of a thousandth under its own weight.
    Fabric fabric = elastic_fabric(strip_density * standard_gravity / 1e-3, strip_density);
    fabric.stretch.shear = 0.5f * fabric.stretch.stretch[0];
    fabric.bend = {.bend = {b, b, b}, .model = bending.model};
    // These meshes have two rows of particles per cell, which need four times the iterations.
    const bool dense = of.cut == Cut::bias_across || of.diagonal == GridDiagonal::cross;
    const std::uint32_t iterations = (dense ? 4 : 1) * settings.iterations;
    WorldSettings world_settings{.solver = {.substeps = 10, .iterations = iterations}};
    world_settings.solver.hierarchy = false;
    World world = validation.make_world(world_settings);
    add_sheet(world,
              {.mesh = strip.mesh, .fabric = fabric, .pinned = [&](Vec3 p) { return strip.along(p) < strip.clamp; }});
    settle(world, 4, 10 * settings.h);
    const ClothFrame& cloth = world.frame().cloths.front();
    double drop = 0, reach = 0;
    for (std::uint32_t p = 0; p < strip.mesh.positions.size(); ++p) {
        if (strip.along(strip.mesh.positions[p]) < strip.tip - 1e-3) continue;
        const Vec3 x = cloth.positions[p].xyz();
        drop -= double{x.y};
        reach += strip.along(x) - root;
    }
    return drop / reach;
}

void check(Validation& validation, const StripOf& strip, std::uint32_t across, const Bending& bending,
           const Settings& settings, double tolerance, double known) {
    char what[120];
    std::snprintf(what, sizeof what, "drop over reach, %s, %s, gamma %g, %u x %u cells", bending.name, strip.name,
                  settings.gamma, settings.cells, across);
    validation.add_near(
        what, drop_over_reach(validation, strip, across, bending, settings), elastica(settings.gamma), tolerance, "",
        known, {{"model", bending.name}, {"mesh", strip.name}, {"gamma", settings.gamma}, {"cells", settings.cells}});
}

// Eight values of gamma at three resolutions each. The middle one comes first.
constexpr Settings narrow[] = {
    {0.1, 10, 1.0 / 4000, 6}, {0.1, 7, 1.0 / 4000, 4},   {0.1, 14, 1.0 / 8000, 8},  {1, 10, 1.0 / 2000, 4},
    {1, 7, 1.0 / 2000, 4},    {1, 14, 1.0 / 2000, 12},   {2, 10, 1.0 / 2000, 6},    {2, 7, 1.0 / 2000, 4},
    {2, 14, 1.0 / 2000, 12},  {5, 10, 1.0 / 1000, 10},   {5, 7, 1.0 / 1000, 8},     {5, 14, 1.0 / 1000, 15},
    {10, 14, 1.0 / 1000, 15}, {10, 10, 1.0 / 1000, 10},  {10, 20, 1.0 / 1000, 20},  {20, 14, 1.0 / 1000, 15},
    {20, 10, 1.0 / 1000, 10}, {20, 20, 1.0 / 1000, 20},  {50, 14, 1.0 / 1000, 15},  {50, 10, 1.0 / 1000, 10},
    {50, 20, 1.0 / 1000, 20}, {100, 14, 1.0 / 1000, 15}, {100, 10, 1.0 / 1000, 10}, {100, 20, 1.0 / 1000, 20}};

// All settings for the default model; for the others three resolutions of gamma 10 and one of the rest.
void check_narrow(Validation& validation, std::span<const StripOf> strips, double (*tolerance)(const StripOf&),
                  double (*known)(const Bending&)) {
    for (const Bending* bending : {&moment, &plate, &dihedral}) {
        for (const StripOf& strip : strips) {
            for (const Settings& settings : narrow) {
                const bool middle = (&settings - narrow) % 3 == 0;
                if (bending != &moment && !middle && settings.gamma != 10) continue;
                const bool first =
                    (&strip == strips.data() || bending == &moment) && settings.gamma == 10 && settings.cells == 10;
                if (validation.quick() && !first) continue;
                check(validation, strip, 2, *bending, settings, tolerance(strip), known(*bending));
            }
        }
    }
}

}  // namespace

void validate_cantilever(Validation& validation) {
    constexpr StripOf strips[] = {{"warp, alternating", Cut::warp, GridDiagonal::alternating},
                                  {"weft, alternating", Cut::weft, GridDiagonal::alternating},
                                  {"warp, uniform", Cut::warp, GridDiagonal::uniform},
                                  {"weft, uniform", Cut::weft, GridDiagonal::uniform}};
    check_narrow(
        validation, strips, [](const StripOf&) { return 0.02; },
        [](const Bending& bending) { return &bending == &dihedral ? 0.2
                                            : &bending == &moment ? 0.05
                                                                  : 0; });
}

void validate_cantilever_meshes(Validation& validation) {
    constexpr StripOf strips[] = {{"warp, cross", Cut::warp, GridDiagonal::cross},
                                  {"bias, diagonals along", Cut::bias_along, GridDiagonal::uniform},
                                  {"bias, diagonals across", Cut::bias_across, GridDiagonal::uniform},
                                  {"irregular", Cut::irregular, GridDiagonal::alternating}};
    check_narrow(
        validation, strips, [](const StripOf& strip) { return strip.diagonal == GridDiagonal::cross ? 0.02 : 0.05; },
        [](const Bending& bending) { return &bending == &moment ? 0.05 : 0.3; });
}

// Strips that are no narrower than cloth: on these a mesh can lift vertices alternately in all directions. The grid
// with `cross` diagonals is an alternating one along its bias.
void validate_wide_cantilever(Validation& validation) {
    constexpr StripOf strips[] = {{"alternating", Cut::warp, GridDiagonal::alternating},
                                  {"alternating, along the bias (cross)", Cut::warp, GridDiagonal::cross},
                                  {"uniform", Cut::warp, GridDiagonal::uniform},
                                  {"irregular", Cut::irregular, GridDiagonal::alternating}};
    constexpr Settings all[] = {{1, 12, 1.0 / 2000, 6}, {10, 12, 1.0 / 1000, 12}, {10, 24, 1.0 / 1000, 30}};
    for (const Bending* bending : {&moment, &plate, &dihedral}) {
        for (const StripOf& strip : strips) {
            for (const Settings& settings : all) {
                const bool irregular = strip.cut == Cut::irregular;
                if (validation.quick() && (bending != &moment || !irregular || settings.gamma != 10)) continue;
                check(validation, strip, 8, *bending, settings, irregular ? 0.05 : 0.02,
                      bending == &moment ? 0.06 : 0.35);
            }
        }
    }
}

}  // namespace weft
