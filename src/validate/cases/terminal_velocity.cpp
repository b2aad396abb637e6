#include "validate/sheets.h"

#include <cmath>
#include <cstdio>

namespace weft {

using namespace cases;

void validate_terminal_velocity(Validation& validation) {
    for (const double density : {0.05, 0.1, 0.2, 0.3}) {
        if (validation.quick() && density != 0.1) continue;
        World world = validation.make_world({.air = AirDesc{}});
        Fabric fabric;
        fabric.body.density = static_cast<float>(density);
        add_sheet(world, {.mesh = make_grid({1, 1}, {9, 9}, GridDiagonal::alternating), .fabric = fabric});
        run(world, 3);
        const auto before = center_of_mass(world);
        run(world, 1);
        const auto after = center_of_mass(world);
        char what[64];
        std::snprintf(what, sizeof what, "speed, %.2f kg/m², 20 substeps", density);
        validation.add_near(what, before[1] - after[1], std::sqrt(2 * density * standard_gravity / (1.225 * 1.28)),
                            0.01, "m/s");
    }
}

}  // namespace weft
