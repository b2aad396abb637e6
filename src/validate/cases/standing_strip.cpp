#include "validate/sheets.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace weft {

using namespace cases;
namespace {

// The farthest that the upper end of a strip of `height` m, clamped at its lower end, leans within 6 s, from a start at
// 0.1 % of its height.
double leans(const Validation& validation, double height, double bend, BendModel model) {
    constexpr std::uint32_t cells = 14;
    constexpr double density = 0.2;
    const double begins = begin_of_bending(model), s = height / (cells - begins), length = cells * s;
    Fabric fabric = elastic_fabric(2000, density);
    fabric.stretch.shear = 500;
    const auto b = static_cast<float>(bend);
    fabric.bend = {.bend = {b, b, b}, .model = model};
    WorldSettings settings{.solver = {.substeps = 10, .iterations = 15}};
    settings.solver.hierarchy = false;
    World world = validation.make_world(settings);
    add_sheet(world, {.mesh = make_grid({static_cast<float>(length), static_cast<float>(2 * s)}, {cells + 1, 3},
                                        GridDiagonal::alternating),
                      .fabric = fabric,
                      .place =
                          [=](Vec3 p) {
                              const double up = double{p.x} + length / 2 - begins * s, t = std::max(up, 0.0) / height;
                              return Vec3{static_cast<float>(1e-3 * height * t * t), static_cast<float>(up), p.z};
                          },
                      .pinned = [=](Vec3 p) { return p.x < -length / 2 + 1.01 * s; }});
    double farthest = 0;
    for (int i = 0; i < 600; ++i) {
        run(world, 0.01, 0.01);
        farthest = std::max(farthest, std::abs(position(world, 2 * (cells + 1) - 1)[0]) / height);
    }
    return farthest;
}

}  // namespace

// A strip stands upright up to the height L with ρ g L³ = 7.837 B. Here the height is 0.5 m and B changes.
void validate_standing_strip(Validation& validation) {
    constexpr double height = 0.5;
    const double critical = 0.2 * standard_gravity * height * height * height / 7.837;
    for (const auto& [of, model] : {std::pair{", moment", BendModel::moment}, std::pair{", plate", BendModel::plate},
                                    std::pair{", dihedral", BendModel::dihedral}}) {
        const bool soft = model == BendModel::dihedral;
        if (validation.quick() && model != BendModel::moment) continue;
        validation.add({.what = std::string("lean over height at 1.1 of the stiffness it needs") + of,
                        .measured = leans(validation, height, 1.1 * critical, model),
                        .expected = 0.02,
                        .bound = Bound::at_most,
                        .known = soft ? 1.0 : 0.0});
        validation.add({.what = std::string("lean over height at 0.9 of the stiffness it needs") + of,
                        .measured = leans(validation, height, 0.9 * critical, model),
                        .expected = 0.2,
                        .bound = Bound::at_least});
    }
}

}  // namespace weft
