#include "validate/sheets.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace weft {

using namespace cases;
namespace {

constexpr double pi = std::numbers::pi, shorter_side = 0.25, drum_radius = 0.1;  // m

// m: the longer side that friction just holds: dT/dφ = μ (T + ρ g R sin φ) + ρ g R cos φ.
double longest_that_holds(double friction, double r) {
    double tension = shorter_side;  // over ρ g
    constexpr int steps = 20000;
    for (int i = 0; i < steps; ++i) {
        const double angle = (i + 0.5) * pi / steps;
        tension += (friction * (tension + r * std::sin(angle)) + r * std::cos(angle)) * pi / steps;
    }
    return tension;
}

// m: how far the longer side of a strip over half a cylinder has sunk after a second.
double sinks(const Validation& validation, double longer, float friction, std::uint32_t substeps) {
    const double r = drum_radius + 0.001, arc = pi * r, all = shorter_side + arc + longer;
    const auto columns = static_cast<std::uint32_t>(std::lround(all / 0.01)) + 1;
    Fabric fabric;
    fabric.contact = {.thickness = 0.002f, .friction = {friction, friction}};
    World world = validation.make_world({.solver = {.substeps = substeps}});
    TriangleMesh mesh = make_grid({static_cast<float>(all), 0.05f}, {columns, 6}, GridDiagonal::alternating);
    const auto place = [=](Vec3 p) {
        const double s = double{p.x} + all / 2 - shorter_side, angle = std::clamp(s / r, 0.0, pi);
        const double below = s < 0 ? -s : std::max(s - arc, 0.0);
        return Vec3{static_cast<float>(-r * std::cos(angle)), static_cast<float>(r * std::sin(angle) - below), p.z};
    };
    for (Vec3& p : mesh.positions) p = place(p);
    add_sheet(world, {.mesh = std::move(mesh), .fabric = fabric});
    ColliderDesc cylinder{.name = "cylinder",
                          .shape = CapsuleDesc{static_cast<float>(drum_radius), 0.3f},
                          .friction = {friction, friction}};
    cylinder.transform.rotation_degrees = {90, 0, 0};
    world.add(make_collider(cylinder));
    const auto lowest = [&] {
        float y = 0;
        for (const Vec4& x : world.frame().cloths[0].positions) y = x.x > 0 ? std::min(y, x.y) : y;
        return double{y};
    };
    run(world, 0.25);
    const double before = lowest();
    run(world, 1);
    return before - lowest();
}

}  // namespace

void validate_capstan(Validation& validation) {
    const double longest = longest_that_holds(0.3, drum_radius + 0.001);
    for (const std::uint32_t substeps : {20u, 80u}) {
        if (validation.quick() && substeps == 20) continue;
        const std::string settings = ", friction 0.3, " + std::to_string(substeps) + " substeps";
        validation.add({.what = "way in 1 s at 0.88 of the length that holds" + settings,
                        .unit = "m",
                        .measured = sinks(validation, 0.88 * longest, 0.3f, substeps),
                        .expected = 0.003,
                        .bound = Bound::at_most,
                        .known = 0});
        validation.add({.what = "way in 1 s at 1.03 of it" + settings,
                        .unit = "m",
                        .measured = sinks(validation, 1.03 * longest, 0.3f, substeps),
                        .expected = 0.005,
                        .bound = Bound::at_least,
                        .known = substeps == 20 ? 0.005 : 0.0});
    }
}

}  // namespace weft
