// A heavy strip that is clamped at one end (protocol of Romero et al. 2021, "Physical Validation of Simulators in
// Computer Graphics: A New Framework Dedicated to Slender Elastic Structures and Frictional Contact").
#include "validate/sheets.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <random>
#include <utility>

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
    GridDiagonal diagonal;
    bool along_weft = false;
    std::uint32_t cells_across = 2;
    bool irregular = false;
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

// Two rows of particles are pinned. The free length of 1 m begins where the sheet begins to bend.
double drop_over_reach(const Validation& validation, const StripOf& strip, const Bending& bending,
                       const Settings& settings) {
    const double begins = begin_of_bending(bending.model), s = 1 / (settings.cells - begins),
                 length = settings.cells * s;
    const auto b = static_cast<float>(strip_density * standard_gravity / settings.gamma);
    // A strain of a thousandth under its own weight.
    Fabric fabric = elastic_fabric(strip_density * standard_gravity / 1e-3, strip_density);
    fabric.stretch.shear = 0.5f * fabric.stretch.stretch[0];
    fabric.bend = {.bend = {b, b, b}, .model = bending.model};
    const std::array<float, 2> size{static_cast<float>(length), static_cast<float>(strip.cells_across * s)};
    const std::uint32_t n = settings.cells + 1, rows = strip.cells_across + 1;
    const bool turned = strip.along_weft;
    TriangleMesh mesh =
        turned ? make_grid({size[1], size[0]}, {rows, n}, strip.diagonal) : make_grid(size, {n, rows}, strip.diagonal);
    if (strip.irregular) {
        std::mt19937 random(5);
        const auto offset = [&] {
            return static_cast<float>(0.25 * s * (static_cast<double>(random() % 2001) / 1000 - 1));
        };
        for (Vec3& p : mesh.positions) {
            const float x = offset(), z = offset();
            const bool inner = double{p.x} > -length / 2 + 1.5 * s && double{p.x} < length / 2 - 0.5 * s &&
                               std::abs(p.z) < size[1] / 2 - 0.5f * static_cast<float>(s);
            if (inner) p.x += x, p.z += z;
        }
    }
    WorldSettings world_settings{.solver = {.substeps = 10, .iterations = settings.iterations}};
    world_settings.solver.hierarchy = false;
    World world = validation.make_world(world_settings);
    const auto along = [turned](Vec3 p) { return turned ? p.z : p.x; };
    add_sheet(world, {.mesh = std::move(mesh), .fabric = fabric, .pinned = [=](Vec3 p) {
                          return along(p) < -length / 2 + 1.01 * s;
                      }});
    settle(world, 4, 10 * settings.h);
    const ClothFrame& cloth = world.frame().cloths.front();
    double drop = 0, reach = 0;
    for (std::uint32_t i = 0; i < rows; ++i) {
        const Vec4 x = cloth.positions[turned ? (n - 1) * rows + i : i * n + n - 1];
        drop -= double{x.y};
        reach += double{along(x.xyz())} + length / 2 - begins * s;
    }
    return drop / reach;
}

}  // namespace

void validate_cantilever(Validation& validation) {
    constexpr StripOf strips[] = {{"warp, alternating", GridDiagonal::alternating},
                                  {"weft, alternating", GridDiagonal::alternating, true},
                                  {"warp, uniform", GridDiagonal::uniform},
                                  {"weft, uniform", GridDiagonal::uniform, true}};
    constexpr Settings all[] = {{0.1, 7, 1.0 / 4000, 4},  {1, 7, 1.0 / 2000, 4},    {1, 10, 1.0 / 2000, 4},
                                {2, 10, 1.0 / 2000, 6},   {5, 10, 1.0 / 1000, 10},  {10, 10, 1.0 / 1000, 10},
                                {10, 14, 1.0 / 1000, 15}, {10, 20, 1.0 / 1000, 20}, {20, 14, 1.0 / 1000, 15},
                                {50, 14, 1.0 / 1000, 15}, {50, 20, 1.0 / 1000, 20}, {100, 20, 1.0 / 1000, 20}};
    for (const Bending* bending : {&moment, &plate, &dihedral}) {
        for (const StripOf& strip : strips) {
            for (const Settings& settings : all) {
                const bool first = &strip == &strips[0] && settings.gamma == 10 && settings.cells == 10;
                if (validation.quick() && !first) continue;
                char what[120];
                std::snprintf(what, sizeof what, "drop over reach, %s, %s, gamma %g, %u cells", bending->name,
                              strip.name, settings.gamma, settings.cells);
                validation.add_near(what, drop_over_reach(validation, strip, *bending, settings),
                                    elastica(settings.gamma), 0.02, "",
                                    bending == &dihedral ? 0.2
                                    : bending == &moment ? 0.05
                                                         : 0);
            }
        }
    }
}

// Strips that are no narrower than cloth: on these a mesh can lift vertices alternately in all directions. The grid
// with `cross` diagonals is an alternating one along its bias.
void validate_wide_cantilever(Validation& validation) {
    constexpr StripOf strips[] = {{"alternating", GridDiagonal::alternating, false, 8},
                                  {"alternating, along the bias (cross)", GridDiagonal::cross, false, 8},
                                  {"uniform", GridDiagonal::uniform, false, 8},
                                  {"irregular", GridDiagonal::alternating, false, 8, true}};
    constexpr Settings all[] = {{1, 12, 1.0 / 2000, 6}, {10, 12, 1.0 / 1000, 12}, {10, 24, 1.0 / 1000, 30}};
    for (const Bending* bending : {&moment, &plate, &dihedral}) {
        for (const StripOf& strip : strips) {
            for (const Settings& settings : all) {
                if (validation.quick() && (bending != &moment || !strip.irregular || settings.gamma != 10)) continue;
                char what[120];
                std::snprintf(what, sizeof what, "drop over reach, %s, %s, gamma %g, %u x 8 cells", bending->name,
                              strip.name, settings.gamma, settings.cells);
                validation.add_near(what, drop_over_reach(validation, strip, *bending, settings),
                                    elastica(settings.gamma), strip.irregular ? 0.05 : 0.02, "",
                                    bending == &moment ? 0.06 : 0.35);
            }
        }
    }
}

}  // namespace weft
