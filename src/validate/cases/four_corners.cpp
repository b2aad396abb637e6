#include "validate/sheets.h"

#include <cmath>

namespace weft {

using namespace cases;
namespace {

// A square meter of cotton that is pinned at its four corners, after 10 s.
Rest shape(const Validation& validation, std::uint32_t side, std::uint32_t substeps, bool levels) {
    WorldSettings settings{.solver = {.substeps = substeps}, .air = AirDesc{}};  // without air it still swings
    settings.solver.hierarchy = levels;
    World world = validation.make_world(settings);
    add_sheet(world, {.mesh = make_grid({1, 1}, {side, side}, GridDiagonal::alternating),
                      .fabric = find_fabric("cotton")->fabric,
                      .pinned = [](Vec3 p) { return std::abs(p.x) > 0.499f && std::abs(p.z) > 0.499f; }});
    const double ms = timed_run(world, 10);
    return {places(world), ms};
}

}  // namespace

void validate_four_corners(Validation& validation) {
    compare_with_converged(validation, shape, [](std::uint32_t) { return 0.007; });
}

}  // namespace weft
