#include "solver/measures/statistics.h"
#include "validate/sheets.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

namespace weft {

using namespace cases;

namespace {

struct Flight {
    double drift = 0;  ///< largest change of momentum, of the root of 2 m E at first
    double most = 0;   ///< most kinetic energy, of that at first
};

// A sheet of cotton that turns and folds where it is, without gravity and air.
Flight fly(const Validation& validation, Compensation compensation, double minutes) {
    World world = validation.make_world({.gravity = {}, .solver = {.compensation = compensation}});
    const Fabric fabric = find_fabric("cotton")->fabric;
    add_sheet(world, {.mesh = make_grid({0.5f, 0.5f}, {9, 9}, GridDiagonal::alternating), .fabric = fabric});
    Snapshot snapshot = world.save();
    ClothSnapshot& cloth = snapshot.cloths.front();
    for (std::size_t p = 0; p < cloth.position.size(); ++p) {
        const Vec4 x = cloth.position[p];
        // A spin about y, and a wave that folds it.
        cloth.velocity[p] = {-3 * x.z, 0.5f * std::sin(9 * x.x) * std::cos(7 * x.z), 3 * x.x, cloth.velocity[p].w};
    }
    if (auto placed = world.restore(snapshot); !placed) throw std::runtime_error(placed.error().message());
    const auto start = momentum(world);
    const double energy = kinetic_energy(world.frame()), mass = 0.25 * double{fabric.body.density},
                 size = std::sqrt(2 * mass * energy);
    Flight flight;
    for (int second = 0; second < static_cast<int>(60 * minutes); ++second) {
        run(world, 1);
        const auto now = momentum(world);
        flight.drift =
            std::max(flight.drift, std::hypot(now[0] - start[0], now[1] - start[1], now[2] - start[2]) / size);
        flight.most = std::max(flight.most, kinetic_energy(world.frame()) / energy);
    }
    return flight;
}

}  // namespace

void validate_free_flight(Validation& validation) {
    const double minutes = validation.quick() ? 0.05 : 10;
    for (const Compensation compensation : {Compensation::off, Compensation::on}) {
        const bool on = compensation == Compensation::on;
        const Flight flight = fly(validation, compensation, minutes);
        char what[80];
        std::snprintf(what, sizeof what, "change of momentum in %g min, 9², compensation %s", minutes,
                      on ? "on" : "off");
        const double known = validation.quick() ? 2.2e-4 : 0.15;
        validation.add({.what = what,
                        .measured = flight.drift,
                        .expected = 1e-5,
                        .bound = Bound::at_most,
                        .known = on ? 0 : known});
        std::snprintf(what, sizeof what, "most kinetic energy in %g min, of that at first, compensation %s", minutes,
                      on ? "on" : "off");
        validation.add({.what = what, .measured = flight.most, .expected = 1, .bound = Bound::at_most});
    }
}

}  // namespace weft
