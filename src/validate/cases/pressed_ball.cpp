#include "validate/sheets.h"

#include <algorithm>
#include <cmath>

namespace weft {

using namespace cases;
namespace {

// A square meter of cotton, pinned along its border, with a ball of 0.2 m that stands 5 cm high in its middle.
Rest shape_over_ball(const Validation& validation, std::uint32_t side, std::uint32_t substeps, bool levels) {
    WorldSettings settings{.solver = {.substeps = substeps}, .air = AirDesc{}};
    settings.solver.hierarchy = levels;
    World world = validation.make_world(settings);
    add_sheet(world, {.mesh = make_grid({1, 1}, {side, side}, GridDiagonal::alternating),
                      .fabric = find_fabric("cotton")->fabric,
                      .pinned = [](Vec3 p) { return std::max(std::abs(p.x), std::abs(p.z)) > 0.499f; }});
    Collider ball = make_collider({.name = "ball", .shape = SphereDesc{0.2f}});
    ball.motion = {{.time = 0, .position = {0, -0.21f, 0}}, {.time = 1, .position = {0, -0.15f, 0}}};
    world.add(std::move(ball));
    const double ms = timed_run(world, 6);
    return {places(world), ms};
}

}  // namespace

void validate_pressed_ball(Validation& validation) {
    compare_with_converged(validation, shape_over_ball,
                           [](std::uint32_t substeps) { return substeps < 10 ? 0.004 : 0.0; });
}

}  // namespace weft
