#include "validate/sheets.h"

#include <cmath>
#include <numbers>
#include <string>

namespace weft {

using namespace cases;
namespace {

constexpr double spring_stiffness = 1000, spring_mass = 1;  // N/m, kg

// s: period of a particle on a spring of 1 m that starts at 1.5 m, without gravity.
double spring_period(const Validation& validation, std::uint32_t substeps) {
    World world = validation.make_world({.gravity = {}, .solver = {.substeps = substeps}});
    // Two triangles whose two upright edges are the only springs: each has half of the sheet's width. The last particle
    // is a corner of both triangles and has a third of the mass.
    Fabric fabric = elastic_fabric(2 * spring_stiffness, 3 * spring_mass);
    fabric.stretch.stretch[0] = fabric.stretch.compression[0] = 0;
    add_sheet(world, {.mesh = make_grid({1, 1}, {2, 2}, GridDiagonal::alternating),
                      .fabric = fabric,
                      .place =
                          [](Vec3 p) {
                              return Vec3{p.x, p.z > 0 ? -1.5f : 0.0f, 0};
                          },
                      .pinned = [](Vec3 p) { return p.z < 0; }});
    constexpr double frame = 1.0 / 240;
    const auto stretch = [&] { return -1 - position(world, 3)[1]; };
    double before = stretch(), first = -1, last = -1;
    int crossings = 0;
    for (int i = 1; crossings < 7 && i < 2000; ++i) {
        run(world, frame, frame);
        const double now = stretch();
        if (before * now < 0) {
            last = (i - now / (now - before)) * frame;
            if (crossings++ == 0) first = last;
        }
        before = now;
    }
    return (last - first) / 3;
}

}  // namespace

// One linear constraint is exactly an implicit Euler step, which lengthens the period.
void validate_oscillator(Validation& validation) {
    const double omega = std::sqrt(spring_stiffness / spring_mass);
    for (const std::uint32_t substeps : {1u, 5u, 15u}) {
        if (validation.quick() && substeps != 5) continue;
        const double h = 1.0 / 240 / substeps;
        validation.add_near("period, substeps of 1/" + std::to_string(240 * substeps) + " s",
                            spring_period(validation, substeps), 2 * std::numbers::pi * h / std::atan(omega * h), 0.002,
                            "s");
    }
}

}  // namespace weft
