#include "validate/sheets.h"

#include <cmath>
#include <cstdio>
#include <numbers>

namespace weft {

using namespace cases;
namespace {

constexpr double per_degree = std::numbers::pi / 180;

// m: how far a sheet slides down a plane.
double slides(const Validation& validation, double degrees, double friction, double seconds) {
    const auto mu = static_cast<float>(friction);
    Fabric fabric;
    fabric.contact = {.thickness = 0.002f, .friction = {mu, mu}};
    const Mat3 turn = rotation_from_degrees({0, 0, -static_cast<float>(degrees)});
    World world = validation.make_world({.solver = {.substeps = 20}});
    add_sheet(
        world,
        {.mesh = make_grid({0.2f, 0.2f}, {7, 7}, GridDiagonal::alternating), .fabric = fabric, .place = [=](Vec3 p) {
             return turn * (p + Vec3{0, 0.001f, 0});
         }});
    ColliderDesc plane{.name = "plane", .shape = PlaneDesc{}, .friction = {mu, mu}};
    plane.transform.rotation_degrees = {0, 0, -static_cast<float>(degrees)};
    world.add(make_collider(plane));
    const auto from = center_of_mass(world);
    run(world, seconds);
    const auto to = center_of_mass(world);
    const Vec3 down = turn * Vec3{1, 0, 0};
    return (to[0] - from[0]) * double{down.x} + (to[1] - from[1]) * double{down.y};
}

}  // namespace

void validate_incline(Validation& validation) {
    const double limit = std::atan(0.5) / per_degree;
    validation.add({.what = "way in 2 s, friction 0.5, 0.5° below the angle at which it slides",
                    .unit = "m",
                    .measured = std::abs(slides(validation, limit - 0.5, 0.5, 2)),
                    .expected = 1e-5,
                    .bound = Bound::at_most});
    validation.add({.what = "way in 2 s, friction 0.5, 0.5° above it",
                    .unit = "m",
                    .measured = slides(validation, limit + 0.5, 0.5, 2),
                    .expected = 0.01,
                    .bound = Bound::at_least});
    constexpr double table[][2] = {{20, 0.3}, {30, 0.3}, {30, 0.5}};
    for (const auto& [degrees, friction] : table) {
        char what[80];
        std::snprintf(what, sizeof what, "way in 1 s, %g° and friction %g", degrees, friction);
        const double a =
            standard_gravity * (std::sin(degrees * per_degree) - friction * std::cos(degrees * per_degree));
        validation.add_near(what, slides(validation, degrees, friction, 1), 0.5 * a * (1 + 1.0 / 1200), 0.01, "m");
    }
}

}  // namespace weft
