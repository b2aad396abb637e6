#include "validate/sheets.h"

#include <cmath>
#include <string>
#include <vector>

namespace weft {

using namespace cases;
namespace {

// A square meter of cotton that is pinned at its four corners, after 10 s.
std::vector<Vec4> shape(const Validation& validation, std::uint32_t side, std::uint32_t substeps, bool levels) {
    WorldSettings settings{.solver = {.substeps = substeps}};
    settings.solver.hierarchy = levels;
    World world = validation.make_world(settings);
    add_sheet(world, {.mesh = make_grid({1, 1}, {side, side}, GridDiagonal::alternating),
                      .fabric = find_fabric("cotton")->fabric,
                      .pinned = [](Vec3 p) { return std::abs(p.x) > 0.499f && std::abs(p.z) > 0.499f; }});
    run(world, 10);
    return places(world);
}

}  // namespace

void validate_four_corners(Validation& validation) {
    const std::uint32_t side = validation.quick() ? 17 : 33;
    const auto converged = shape(validation, side, 300, false);
    for (const std::uint32_t substeps : {5u, 10u, 20u, 60u}) {
        if (validation.quick() && substeps != 20) continue;
        validation.add({.what = "distance from the converged sheet (RMS), " + std::to_string(side) + "², " +
                                std::to_string(substeps) + " substeps, default solver",
                        .unit = "m",
                        .measured = rms_distance(shape(validation, side, substeps, true), converged),
                        .expected = 0.003,
                        .bound = Bound::at_most,
                        .known = 0.03});
    }
}

}  // namespace weft
