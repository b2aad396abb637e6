#include "physics/bend/hinge_at_rest.h"
#include "physics/constraint.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace weft {
namespace {

// A hinge as it turns: how far its tips are apart, m. They keep their places along the edge.
struct Tips {
    double along = 0, c = 0, d = 0;  // m: between their feet on the edge; heights over it

    Tips(const Topology& topology, const Hinge& hinge) {
        const auto& x = topology.rest_positions;
        const Vec3 e = x[hinge.b] - x[hinge.a];
        const double edge = static_cast<double>(length(e));
        const auto foot = [&](std::uint32_t p) { return static_cast<double>(dot(x[p] - x[hinge.a], e)) / edge; };
        const auto height = [&](std::uint32_t p) {
            return static_cast<double>(length(cross(x[p] - x[hinge.a], e))) / edge;
        };
        along = foot(hinge.c) - foot(hinge.d);
        c = height(hinge.c), d = height(hinge.d);
    }
    double apart(double angle) const {
        return std::sqrt(std::max(along * along + c * c + d * d + 2 * c * d * std::cos(angle), 0.0));
    }
};

}  // namespace

RowList build_flexion(const RestShape& rest, const FlexionMaterial& material) {
    // Where a row holds as much energy as the hinge that it stands for: folded by a right angle from where it is at
    // ease, to the side to which its tips move more.
    constexpr double fold = std::numbers::pi / 2;
    RowList rows = make_rows(ConstraintKind::flexion);
    if (material.model != BendModel::distance) return rows;
    for (const Hinge& hinge : rest.topology.hinges) {
        const auto at_rest = hinge_at_rest(rest, hinge, material);
        if (!at_rest) continue;
        const Tips tips(rest.topology, hinge);
        const double angle = static_cast<double>(at_rest->angle), apart = tips.apart(angle);
        const double moved =
            std::max(std::abs(apart - tips.apart(angle + fold)), std::abs(apart - tips.apart(angle - fold)));
        const double compliance = static_cast<double>(at_rest->compliance) * moved * moved / (fold * fold);
        if (!(compliance > 0) || !std::isfinite(apart)) continue;
        rows.add({hinge.c, hinge.d}, {static_cast<float>(apart), static_cast<float>(compliance)});
    }
    return rows;
}

}  // namespace weft
