#include "validate/sheets.h"

#include <cmath>
#include <cstdio>

namespace weft {

using namespace cases;

// A box of 0.2 m on a square meter of cotton that lies on a table.
void validate_table_cloth(Validation& validation) {
    const Fabric fabric = find_fabric("cotton")->fabric;
    const float half = 0.1f, thickness = fabric.contact.thickness;
    for (const double mass : {0.01, 0.3, 10.0, 300.0}) {
        if (validation.quick() && mass != 10) continue;
        World world = validation.make_world({.contact_forces = true});
        SheetOf sheet{.mesh = make_grid({1, 1}, {21, 21}, GridDiagonal::alternating), .fabric = fabric};
        for (Vec3& p : sheet.mesh.positions) p.y = 0.5f * thickness;
        add_sheet(world, std::move(sheet));
        world.add(make_collider({.name = "table", .shape = PlaneDesc{}}));
        const ColliderId id = add_body(world, BoxDesc{{half, half, half}}, {.mass = static_cast<float>(mass)},
                                       {0.02f, half + thickness, 0.01f});
        run(world, 2);
        const Vec3 before = world.body(id).state.place.xyz();
        double force = 0;
        for (int frame = 0; frame < 60; ++frame) {
            world.step(1.0 / 60);
            world.summary();
            force -= double{world.contact_forces().colliders.front().force.y} / 60;
        }
        const Vec3 after = world.body(id).state.place.xyz();
        char what[80];
        std::snprintf(what, sizeof what, "height of a box of %g kg above the table", mass);
        validation.add({.what = what,
                        .unit = "m",
                        .measured = double{after.y - half},
                        .expected = double{thickness},
                        .tolerance = 0.05 * double{thickness}});
        std::snprintf(what, sizeof what, "force on the table under %g kg", mass);
        validation.add_near(what, force, (mass + double{fabric.body.density}) * standard_gravity, 0.02, "N");
        std::snprintf(what, sizeof what, "way of a box of %g kg in 1 s", mass);
        validation.add({.what = what,
                        .unit = "m",
                        .measured = std::hypot(double{after.x - before.x}, double{after.z - before.z}),
                        .expected = 1e-3,
                        .bound = Bound::at_most});
    }
}

}  // namespace weft
