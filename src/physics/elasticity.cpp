#include "physics/elasticity.h"

#include <weft/bounds.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace weft {

// Strain of an orthotropic sheet under tension in one direction, without transverse contraction (Jones 1999, "Mechanics
// of Composite Materials", section 2.6).
double Elasticity::along(double cos2) const {
    const double sin2 = 1 - cos2, mixed = cos2 * sin2;
    const auto part = [](double share, double strain) { return share > 0 ? share * strain : 0; };
    return part(cos2 * cos2, warp) + part(sin2 * sin2, weft) + part(mixed, shear);
}

double Elasticity::eased(double of) const {
    return of > straight ? straight + (of - straight) / WEFT_STRAIGHT_STIFFNESS : of;
}

double Elasticity::reserve() const {
    return std::max(warp, weft) * tension;
}

float extent_of(const Topology& topology) {
    return length(bounds_of(topology.rest_positions).size());
}

Elasticity elasticity_of(const StretchMaterial& material, float density, float extent) {
    if (material.inextensible) return {};
    constexpr double gravity = 9.81;
    const auto strain = [](float stiffness) {
        return stiffness > 0 ? 1 / static_cast<double>(stiffness) : std::numeric_limits<double>::infinity();
    };
    Elasticity elasticity{
        .warp = strain(material.stretch[0]), .weft = strain(material.stretch[1]), .shear = strain(material.shear)};
    const auto straight = [&](int k) { return double{material.stretch_limit[k]} * double{material.stretch[k]}; };
    if (straight(0) > 0 && straight(1) > 0) elasticity.straight = std::max(straight(0), straight(1));
    elasticity.tension = elasticity.eased(3 * static_cast<double>(density) * gravity * extent);
    return elasticity;
}

namespace {

Limit tighter(const Elasticity& elasticity, double length, double strain, double threads) {
    const double of_threads = std::max(elasticity.warp, elasticity.weft);
    const double elastic = length * (1 + strain * elasticity.tension), turned = threads * (1 + elasticity.reserve());
    return elastic <= turned ? Limit{elastic, length * strain} : Limit{turned, threads * of_threads};
}

}  // namespace

Limit limit_along(const Elasticity& elasticity, double length, double along_warp, double along_weft) {
    const double warp2 = along_warp * along_warp, weft2 = along_weft * along_weft;
    const double cos2 = warp2 + weft2 > 0 ? warp2 / (warp2 + weft2) : 1;
    return tighter(elasticity, length, elasticity.along(cos2), std::max(length, along_warp + along_weft));
}

Limit limit_any_way(const Elasticity& elasticity, double length) {
    double softest = 0;
    for (const double cos2 : {0.0, 0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875, 1.0})
        softest = std::max(softest, elasticity.along(cos2));
    return tighter(elasticity, length, softest, std::numbers::sqrt2 * length);
}

}  // namespace weft
