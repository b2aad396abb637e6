#include "validate/sheets.h"

#include <cmath>
#include <cstdio>

namespace weft {

using namespace cases;
namespace {

constexpr double kite_drag = 1.28, kite_lift = 0.6, air_density = 1.225;

// A limp sheet that is held by its upper edge in a steady wind is straight: where all of it has one angle, each part
// has the same load, and a chain under an even load lies along it. The angle from the vertical, rad, at which wind and
// weight have no part across the sheet.
double kite_angle(double speed, double density) {
    const double pressure = 0.5 * air_density * speed * speed, weight = density * standard_gravity;
    double low = 0, high = std::acos(-1.0) / 2;
    for (int i = 0; i < 60; ++i) {
        const double angle = (low + high) / 2, c = std::cos(angle), s = std::sin(angle);
        const double across = pressure * (kite_drag * c * c + kite_lift * c * s * s) - weight * s;
        (across > 0 ? low : high) = angle;
    }
    return (low + high) / 2;
}

// The angle of a sheet that comes to rest from upright.
double flown(const Validation& validation, double speed, double density, std::uint32_t substeps) {
    AirDesc air;
    air.wind = {WindDesc{.velocity = {static_cast<float>(speed), 0, 0}}};
    World world = validation.make_world({.solver = {.substeps = substeps}, .air = air});
    Fabric fabric = elastic_fabric(2000, density);
    fabric.body.damping = 0.1f;
    add_sheet(world, {.mesh = make_grid({1, 1}, {17, 17}, GridDiagonal::alternating),
                      .fabric = fabric,
                      .place =
                          [](Vec3 p) {
                              return Vec3{0, -0.5f - p.z, p.x};
                          },
                      .pinned = [](Vec3 p) { return p.z < -0.499f; }});
    run(world, 20);
    // The mean over a second: a sheet in wind never stops entirely.
    double along = 0, down = 0;
    for (int i = 0; i < 60; ++i) {
        run(world, 1.0 / 60);
        const auto center = center_of_mass(world);
        along += center[0], down -= center[1];
    }
    return std::atan2(along, down);
}

}  // namespace

void validate_kite(Validation& validation) {
    constexpr double degrees = 57.29577951308232;
    for (const double speed : {2.0, 4.0, 6.0}) {
        for (const std::uint32_t substeps : {10u, 20u}) {
            if (validation.quick() && (speed != 4 || substeps != 20)) continue;
            char what[80];
            std::snprintf(what, sizeof what, "angle in a wind of %g m/s, 0.2 kg/m², %u substeps", speed, substeps);
            validation.add_near(what, degrees * flown(validation, speed, 0.2, substeps),
                                degrees * kite_angle(speed, 0.2), 0.01, "°");
        }
    }
}

}  // namespace weft
