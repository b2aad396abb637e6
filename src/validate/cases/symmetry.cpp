#include "validate/sheets.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace weft {

using namespace cases;
namespace {

// m: the largest distance of a particle from the mirror image of its partner. A sheet of 1 m that hangs by two corners.
double asymmetry(const Validation& validation, std::uint32_t substeps, std::uint32_t iterations) {
    constexpr std::uint32_t side = 9;  // an even number of cells: alternating diagonals then mirror each other
    World world = validation.make_world({.solver = {.substeps = substeps, .iterations = iterations}});
    SheetOf sheet{.mesh = make_grid({1, 1}, {side, side}, GridDiagonal::alternating)};
    for (Vec3& p : sheet.mesh.positions) p = {p.x, -p.z, 0};
    sheet.pinned = [](Vec3 p) { return p.y > 0.49f && std::abs(p.x) > 0.49f; };
    add_sheet(world, std::move(sheet));
    settle(world, 6);
    double worst = 0;
    for (std::uint32_t iz = 0; iz < side; ++iz) {
        for (std::uint32_t ix = 0; ix < side; ++ix) {
            const auto a = position(world, iz * side + ix), b = position(world, iz * side + side - 1 - ix);
            worst = std::max(worst, std::hypot(a[0] + b[0], a[1] - b[1], a[2] - b[2]));
        }
    }
    return worst;
}

}  // namespace

// Constraints are projected one color after another, and the mirror image of a constraint may have another color. The
// effect is no larger than what the constraints leave unsolved.
void validate_symmetry(Validation& validation) {
    for (const auto& [substeps, iterations] : {std::pair{20u, 1u}, std::pair{10u, 20u}}) {
        if (validation.quick() && iterations > 1) continue;
        validation.add({.what = "distance from the mirror image, 9², " + std::to_string(substeps) + " x " +
                                std::to_string(iterations),
                        .unit = "m",
                        .measured = asymmetry(validation, substeps, iterations),
                        .expected = 1e-4,
                        .bound = Bound::at_most});
    }
}

}  // namespace weft
