#include "validate/sheets.h"

#include <cmath>
#include <numbers>
#include <string>

namespace weft {

using namespace cases;
namespace {

// s: period of a sheet of 1 m that swings about its upper edge by a small angle, from the motion of its lower end.
double period(const Validation& validation, std::uint32_t substeps) {
    constexpr std::uint32_t side = 33;
    Fabric fabric = elastic_fabric(0, 0.2);
    fabric.stretch.inextensible = true;
    World world = validation.make_world({.solver = {.substeps = substeps, .iterations = 4}});
    constexpr double angle = 0.02;
    // The shape of the first mode, J0(2.4048 √(1 − s/L)) with s from the edge, starts it without the others.
    add_sheet(world, {.mesh = make_grid({0.25f, 1}, {9, side}, GridDiagonal::alternating),
                      .fabric = fabric,
                      .place =
                          [](Vec3 p) {
                              const double s = double{p.z} + 0.5;
                              const double aside =
                                  angle * std::cyl_bessel_j(0, 2.4048256 * std::sqrt(std::max(1 - s, 0.0)));
                              return Vec3{p.x, static_cast<float>(-s), static_cast<float>(aside)};
                          },
                      .pinned = [](Vec3 p) { return p.z < -0.499f; }});
    double before = position(world, (side - 1) * 9 + 4)[2], first = -1, last = -1;
    int crossings = 0;
    constexpr double frame = 1.0 / 60;
    for (int i = 1; crossings < 7; ++i) {
        run(world, frame, frame);
        const double now = position(world, (side - 1) * 9 + 4)[2];
        if (before * now < 0) {
            last = (i - now / (now - before)) * frame;
            if (crossings++ == 0) first = last;
        }
        before = now;
        if (i > 2000) break;
    }
    return (last - first) / 3;
}

}  // namespace

void validate_swinging_sheet(Validation& validation) {
    const double exact = 4 * std::numbers::pi / 2.4048256 * std::sqrt(1 / standard_gravity);
    for (const std::uint32_t substeps : {20u, 80u}) {
        if (validation.quick() && substeps > 20) continue;
        const double h = 1.0 / 60 / substeps, omega = 2 * std::numbers::pi / exact;
        validation.add_near("period, 32 cells, " + std::to_string(substeps) + " x 4", period(validation, substeps),
                            2 * std::numbers::pi * h / std::atan(omega * h), 0.005, "s");
    }
}

}  // namespace weft
