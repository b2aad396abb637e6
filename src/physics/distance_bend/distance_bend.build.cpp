#include "physics/bend/hinge_at_rest.h"
#include "physics/change_rows.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>

namespace weft {
namespace {

// The distance between the tips of a hinge as it folds, m. Folding does not move the tips along the edge.
struct Tips {
    double along = 0, c = 0, d = 0;  // m: distance of their projections on the edge; heights over it

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

// The constraint stores as much energy as the hinge it replaces when the hinge is folded by a right angle from its rest
// angle, to the side on which the distance of the tips changes more.
constexpr double fold = std::numbers::pi / 2;

// m/N. `moved` is the change of the distance at that fold.
double compliance_of(const BendLaw& law, float stiffness, float area, float edge_squared, double moved) {
    return static_cast<double>(law.compliance(stiffness, area, edge_squared)) * moved * moved / (fold * fold);
}

}  // namespace

RowList build_distance_bend(const RestShape& rest, const DistanceBendMaterial& material) {
    RowList rows = make_rows(ConstraintKind::distance_bend);
    if (material.model != BendModel::distance) return rows;
    const BendLaw law(material);
    rows.geometry_count = 5;
    for_each_stiff_hinge(rest, material, rows, [&](const Hinge& hinge, const HingeShape& shape, float stiffness) {
        const Tips tips(rest.topology, hinge);
        const auto angle = static_cast<double>(angle_at_rest(rest.topology, hinge, material));
        const double apart = tips.apart(angle);
        const double moved =
            std::max(std::abs(apart - tips.apart(angle + fold)), std::abs(apart - tips.apart(angle - fold)));
        const double compliance = compliance_of(law, stiffness, shape.area, shape.edge_squared, moved);
        if (!(compliance > 0) || !std::isfinite(apart)) return;
        const auto [low, high] = std::bit_cast<std::array<float, 2>>(moved);
        rows.add({hinge.c, hinge.d}, {static_cast<float>(apart), static_cast<float>(compliance)},
                 {shape.across, shape.area, shape.edge_squared, low, high});
    });
    return rows;
}

bool change_distance_bend(const RowsToChange& rows, const DistanceBendMaterial& material) {
    const BendLaw law(material);
    for (const float across : rows.left_out)
        if (law.stiffness(across) > 0) return false;
    for (std::uint32_t row = 0; row < rows.stride; ++row) {
        const auto number = [&](std::uint32_t which) { return rows.geometry[std::size_t{which} * rows.stride + row]; };
        if (number(1) < 0) continue;
        const float stiffness = law.stiffness(number(0));
        const auto moved = std::bit_cast<double>(std::array{number(3), number(4)});
        const double compliance = compliance_of(law, stiffness, number(1), number(2), moved);
        if (!(stiffness > 0) || !(compliance > 0)) return false;
        rows.fields[rows.stride + row] = static_cast<float>(compliance);
    }
    return true;
}

}  // namespace weft
