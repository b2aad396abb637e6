#include "validate/sheets.h"

#include <cstdio>

namespace weft {

using namespace cases;

// A sheet of cotton of 1 m that hangs by its upper edge, with a crate pinned to its lower edge.
void validate_crate(Validation& validation) {
    constexpr std::uint32_t side = 17;
    for (const double mass : {1.0, 20.0}) {
        if (validation.quick() && mass != 20) continue;
        World world = validation.make_world({.air = AirDesc{}});
        const BodyDesc body{.mass = static_cast<float>(mass), .damping = 3, .spin_damping = 3};
        const ColliderId id = add_body(world, BoxDesc{{0.5f, 0.1f, 0.1f}}, body, {0, -1.1f, 0});
        const Fabric fabric = find_fabric("cotton")->fabric;
        SheetOf sheet{.mesh = make_grid({1, 1}, {side, side}, GridDiagonal::alternating), .fabric = fabric};
        for (Vec3& p : sheet.mesh.positions) p = {p.x, -0.5f - p.z, 0};
        sheet.pinned = [](Vec3 p) { return p.y > -0.001f || p.y < -0.999f; };
        sheet.targets.motions.push_back({.collider = id});
        for (std::uint32_t ix = 0; ix < side; ++ix) {
            const std::uint32_t p = (side - 1) * side + ix;
            sheet.targets.particles.push_back({p, 0, to_local(world.collider(id).pose, sheet.mesh.positions[p])});
        }
        add_sheet(world, std::move(sheet));
        run(world, 8);
        const double weight = mass + 0.5 * double{fabric.body.density};
        char what[80];
        std::snprintf(what, sizeof what, "extension, crate of %g kg, 17², 20 substeps", mass);
        validation.add_near(what, -1 - position(world, (side - 1) * side + side / 2)[1],
                            weight * standard_gravity / double{fabric.stretch.stretch[1]}, 0.01, "m");
        std::snprintf(what, sizeof what, "speed at rest, crate of %g kg", mass);
        validation.add({.what = what,
                        .unit = "m/s",
                        .measured = double{length(world.body(id).state.velocity.xyz())},
                        .expected = 1e-3,
                        .bound = Bound::at_most});
    }
}

}  // namespace weft
