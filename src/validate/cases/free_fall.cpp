#include "validate/sheets.h"

namespace weft {

using namespace cases;

void validate_free_fall(Validation& validation) {
    for (const std::uint32_t substeps : {1u, 20u, 60u, 252u}) {
        if (validation.quick() && substeps > 60) continue;
        World world = validation.make_world({.solver = {.substeps = substeps}});
        add_sheet(world, {.place = [](Vec3 p) { return p + Vec3{0.3f, 10, -0.2f}; }});
        const auto before = center_of_mass(world);
        run(world, 1);
        const auto after = center_of_mass(world);
        const double h = 1.0 / 60 / substeps;
        const std::string settings = std::to_string(substeps) + " substeps";
        validation.add_near("distance after 1 s, " + settings, before[1] - after[1], 0.5 * standard_gravity * (1 + h),
                            1e-5, "m");
        validation.add({.what = "motion aside, " + settings,
                        .unit = "m",
                        .measured = std::max(std::abs(after[0] - before[0]), std::abs(after[2] - before[2])),
                        .expected = 1e-6,
                        .bound = Bound::at_most});
    }
}

}  // namespace weft
