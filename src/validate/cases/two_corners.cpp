#include "validate/sheets.h"

#include <cmath>

namespace weft {

using namespace cases;
namespace {

// An upright square meter of cotton that hangs by two corners, after 10 s.
Rest shape_between_two(const Validation& validation, std::uint32_t side, std::uint32_t substeps, bool levels) {
    WorldSettings settings{.solver = {.substeps = substeps}, .air = AirDesc{}};
    settings.solver.hierarchy = levels;
    World world = validation.make_world(settings);
    SheetOf sheet{.mesh = make_grid({1, 1}, {side, side}, GridDiagonal::alternating),
                  .fabric = find_fabric("cotton")->fabric};
    // Not quite flat, so that it folds to the same side in all runs.
    for (Vec3& p : sheet.mesh.positions) p = {p.x, 0.995f * -p.z, 0.1f * p.z};
    sheet.pinned = [](Vec3 p) { return p.y > 0.49f && std::abs(p.x) > 0.499f; };
    add_sheet(world, std::move(sheet));
    Rest rest{.places = {}, .ms_per_frame = timed_run(world, 10)};
    rest.places = places(world);
    // Across the sheet, folds of two converged runs differ by centimeters.
    for (Vec4& x : rest.places) x.z = 0;
    return rest;
}

}  // namespace

void validate_two_corners(Validation& validation) {
    compare_with_converged(validation, shape_between_two, [](std::uint32_t) { return 0.003; });
}

}  // namespace weft
