#include "validate/sheets.h"

#include <cmath>
#include <cstdio>

namespace weft {

using namespace cases;
namespace {

// Sag over span of a strip of this length over its span of 1 m.
double sag_of(const Validation& validation, double length) {
    constexpr std::uint32_t cells = 32;
    Fabric fabric = elastic_fabric(0, 0.2);
    fabric.stretch.inextensible = true;
    const auto end = static_cast<float>(0.4999 * length);
    // It starts as an arc of a circle: sin a/a = 1/length.
    double a = 1;
    for (int i = 0; i < 60; ++i) a -= (std::sin(a) - a / length) / (std::cos(a) - 1 / length);
    const double radius = length / (2 * a);
    World world = validation.make_world({.solver = {.substeps = 20, .iterations = 20}});
    add_sheet(world, {.mesh = make_grid({static_cast<float>(length), static_cast<float>(2 * length / cells)},
                                        {cells + 1, 3}, GridDiagonal::alternating),
                      .fabric = fabric,
                      .place =
                          [=](Vec3 p) {
                              const double at = double{p.x} / radius;
                              return Vec3{static_cast<float>(radius * std::sin(at)),
                                          static_cast<float>(radius * (std::cos(a) - std::cos(at))), p.z};
                          },
                      .pinned = [=](Vec3 p) { return std::abs(p.x) > end; }});
    settle(world, 4, 0.01);
    // Rounding keeps a limp strip in slight motion, so the depth is a mean over half a second.
    double sum = 0;
    for (int i = 0; i < 50; ++i) {
        run(world, 0.01, 0.01);
        sum -= position(world, cells + 1 + cells / 2)[1];
    }
    return sum / 50;
}

}  // namespace

// L/d and the sag over the span d: y = c cosh(x/c), L = 2c sinh(d/2c), sag = c (cosh(d/2c) − 1).
void validate_catenary(Validation& validation) {
    constexpr double table[][2] = {{1.05, .13930}, {1.1, .20030}, {1.2, .29234}, {1.5, .50263}, {2, .79639}};
    for (const auto& [length, expected] : table) {
        if (validation.quick() && length != 1.2) continue;
        char what[64];
        std::snprintf(what, sizeof what, "sag over span, length %.2f of the span", length);
        validation.add_near(what, sag_of(validation, length), expected, 0.005, "");
    }
}

}  // namespace weft
