#include "validate/sheets.h"

#include <string>
#include <utility>

namespace weft {

using namespace cases;
namespace {

constexpr double hung_stiffness = 60, hung_density = 0.2;

// A sheet of 1 m that hangs by its upper edge until it rests.
World hang(const Validation& validation, const WorldSettings& settings, std::uint32_t side, double frame_seconds) {
    World world = validation.make_world(settings);
    // Square cells: on others the diagonals carry a part of the load.
    add_sheet(world, {.mesh = make_grid({4.0f / static_cast<float>(side - 1), 1}, {5, side}, GridDiagonal::alternating),
                      .fabric = elastic_fabric(hung_stiffness, hung_density),
                      .place =
                          [](Vec3 p) {
                              return Vec3{p.x, -0.5f - p.z, 0};
                          },
                      .pinned = [](Vec3 p) { return p.z < -0.499f; }});
    // Half of the lowest period, 4 L √(ρ/K).
    settle(world, 4, frame_seconds);
    return world;
}

double tip(const World& world, std::uint32_t side) {
    return -1 - position(world, (side - 1) * 5 + 2)[1];
}

}  // namespace

void validate_hanging_sheet(Validation& validation) {
    for (const std::uint32_t side : {9u, 17u, 33u}) {
        if (validation.quick() && side != 17) continue;
        const World world = hang(validation, {.solver = {.substeps = 20, .iterations = 4}}, side, 1.0 / 60);
        const std::string settings = std::to_string(side - 1) + " cells, 20 x 4";
        validation.add_near("tip, " + settings, tip(world, side),
                            hung_density * standard_gravity / (2 * hung_stiffness), 0.01, "m");
        // Particles of alternating grids differ in mass, so this is a mean over the columns.
        const double s = 1.0 / (side - 1);
        double top = -1;
        for (std::uint32_t column = 0; column < 5; ++column)
            top += (column % 4 == 0 ? 0.125 : 0.25) * (position(world, column)[1] - position(world, 5 + column)[1]) / s;
        validation.add_near("strain of the top cell, " + settings, top,
                            hung_density * standard_gravity * (1 - s / 2) / hung_stiffness, 0.01, "");
    }
}

void validate_time_steps(Validation& validation) {
    const double expected = hung_density * standard_gravity / (2 * hung_stiffness);
    double plain[2] = {};
    for (const int rate : {60, 240, 960}) {
        if (validation.quick() && rate == 240) continue;
        const std::string frame = "frames of 1/" + std::to_string(rate) + " s";
        for (const auto& [substeps, iterations] : {std::pair{2u, 40u}, std::pair{20u, 4u}}) {
            const SolverDesc solver{.substeps = substeps, .iterations = iterations};
            const double sag = tip(hang(validation, {.solver = solver}, 17, 1.0 / rate), 17);
            const std::string steps = std::to_string(substeps) + " x " + std::to_string(iterations);
            validation.add_near("tip, " + steps + ", " + frame, sag, expected, 0.01, "m");
        }
        if (rate == 240) continue;
        WorldSettings settings{.solver = {.substeps = 2, .iterations = 5}};
        settings.solver.method = Method::pbd;
        settings.solver.hierarchy = false;
        World world = validation.make_world(settings);
        Fabric fabric = elastic_fabric(hung_stiffness, hung_density);
        fabric.body.stiffness[0] = fabric.body.stiffness[1] = 0.02f;
        add_sheet(world, {.mesh = make_grid({0.25f, 1}, {5, 17}, GridDiagonal::alternating),
                          .fabric = fabric,
                          .place =
                              [](Vec3 p) {
                                  return Vec3{p.x, -0.5f - p.z, 0};
                              },
                          .pinned = [](Vec3 p) { return p.z < -0.499f; }});
        settle(world, 20, 1.0 / rate);
        plain[rate == 960] = tip(world, 17);
    }
    validation.add({.what = "control: tip with pbd at 1/60 s over that at 1/960 s",
                    .measured = plain[0] / plain[1],
                    .expected = 10,
                    .bound = Bound::at_least});
}

}  // namespace weft
