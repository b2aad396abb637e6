#include "validate/sheets.h"

#include <cmath>
#include <numbers>
#include <string>

namespace weft {

using namespace cases;
namespace {

constexpr double membrane_stiffness = 300, membrane_shear = 100, membrane_strain = 0.2, ball_load = 2,
                 ball_radius = 0.2;  // N/m, N, m

// m: height of the middle of a ball above the border of a square of 1 m that is stretched to 1.2 m.
double height(const Validation& validation, std::uint32_t side, std::uint32_t substeps) {
    World world = validation.make_world({.solver = {.substeps = substeps}, .air = AirDesc{}});
    Fabric fabric = elastic_fabric(membrane_stiffness, 0.1);
    fabric.stretch.shear = static_cast<float>(membrane_shear);
    fabric.body.damping = 1;
    SheetOf sheet{.mesh = make_grid({1, 1}, {side, side}, GridDiagonal::alternating), .fabric = fabric};
    sheet.pinned = [](Vec3 p) { return std::max(std::abs(p.x), std::abs(p.z)) > 0.499f; };
    for (std::uint32_t p = 0; p < sheet.mesh.positions.size(); ++p) {
        const Vec3 x = sheet.mesh.positions[p];
        if (!sheet.pinned(x)) continue;
        const auto part = static_cast<float>(membrane_strain);
        sheet.targets.motions.push_back({.offsets = {{0, {}}, {0.5f, {x.x * part, 0, x.z * part}}}});
        sheet.targets.particles.push_back({p, static_cast<std::uint32_t>(sheet.targets.motions.size() - 1), x});
    }
    add_sheet(world, std::move(sheet));
    run(world, 1);
    const BodyDesc body{.mass = static_cast<float>(ball_load / standard_gravity), .damping = 4, .spin_damping = 4};
    const auto r = static_cast<float>(ball_radius);
    const ColliderId id = add_body(world, SphereDesc{r}, body, {0, r + 0.01f, 0});
    run(world, 6);
    return double{world.body(id).state.place.y};
}

}  // namespace

// Outside the circle of ball_radius c that touches the ball, the sheet is an ideal membrane of tension T with the slope
// P/(2π T r) of a point ball_load. At the circle this is the slope of the ball, c/R. The depth at the circle follows
// from the conformal radius of a square of side a at its center, 0.5394 a (Pólya and Szegő 1951).
void validate_membrane(Validation& validation) {
    // Both threads and the shear springs carry a strain in both directions: sigma = (k + 2 K_s) epsilon, where the
    // uniaxial stiffness is K = k + K_s k/(k + K_s) (stretch.md).
    const double b = membrane_stiffness - 2 * membrane_shear,
                 k = 0.5 * (b + std::sqrt(b * b + 4 * membrane_stiffness * membrane_shear));
    const double side = 1 + membrane_strain, tension = (k + 2 * membrane_shear) * membrane_strain / side,
                 spread = ball_load / (2 * std::numbers::pi * tension);
    const double circle = std::sqrt(spread * ball_radius);
    const double depth = spread * std::log(0.5394 * side / circle);
    const double expected = ball_radius - std::sqrt(ball_radius * ball_radius - circle * circle) + depth;
    for (const std::uint32_t substeps : {10u, 20u, 40u}) {
        if (validation.quick() && substeps != 20) continue;
        const std::uint32_t resolution = validation.quick() ? 33 : 65;
        validation.add_near(
            "depth of the ball, " + std::to_string(resolution) + "², " + std::to_string(substeps) + " substeps",
            ball_radius - height(validation, resolution, substeps), expected, 0.05, "m");
    }
}

}  // namespace weft
