#include "validate/sheets.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace weft {

using namespace cases;
namespace {

constexpr float bouncing_radius = 0.15f, fall_height = 1;  // m

// How high a ball of 4 kg bounces, of the height from which it falls on a sheet of rubber that is stretched by a tenth.
double rebound(const Validation& validation, std::uint32_t side, std::uint32_t substeps) {
    World world = validation.make_world({.solver = {.substeps = substeps}, .air = AirDesc{}});
    SheetOf sheet{.mesh = make_grid({2, 2}, {side, side}, GridDiagonal::alternating),
                  .fabric = find_fabric("rubber")->fabric};
    sheet.pinned = [](Vec3 p) { return std::max(std::abs(p.x), std::abs(p.z)) > 0.999f; };
    for (std::uint32_t p = 0; p < sheet.mesh.positions.size(); ++p) {
        const Vec3 x = sheet.mesh.positions[p];
        if (!sheet.pinned(x)) continue;
        sheet.targets.motions.push_back({.offsets = {{0, {}}, {0.5f, {0.1f * x.x, 0, 0.1f * x.z}}}});
        sheet.targets.particles.push_back({p, static_cast<std::uint32_t>(sheet.targets.motions.size() - 1), x});
    }
    add_sheet(world, std::move(sheet));
    run(world, 2);
    const double level = position(world, side * side / 2)[1];
    const ColliderId id = add_body(world, SphereDesc{bouncing_radius}, {.mass = 4},
                                   {0, static_cast<float>(level) + bouncing_radius + fall_height, 0});
    for (int frame = 0; frame < 240; ++frame) {
        run(world, 1.0 / 60);
        const BodyState& state = world.body(id).state;
        const double height = double{state.place.y} - double{bouncing_radius} - level, v = state.velocity.y;
        // Nothing but gravity acts on the ball once it has left the sheet by a tenth of the fall.
        if (v > 0 && height > 0.1 * double{fall_height})
            return (height + v * v / (2 * standard_gravity)) / double{fall_height};
    }
    return 0;
}

}  // namespace

void validate_trampoline(Validation& validation) {
    const std::uint32_t side = validation.quick() ? 17 : 65;
    const double few = rebound(validation, side, 10), many = rebound(validation, side, 20);
    validation.add({.what = "height of the first rebound, of that of the fall, 10 substeps",
                    .measured = few,
                    .expected = 0.65,
                    .tolerance = 0.25});
    validation.add({.what = "the same, 20 substeps", .measured = many, .expected = 0.65, .tolerance = 0.25});
    validation.add_near("10 over 20 substeps", few / many, 1, 0.05, "", validation.quick() ? 0.11 : 0.16);
}

}  // namespace weft
