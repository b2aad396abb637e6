#include "physics/bend/hinge_at_rest.h"
#include "physics/change_rows.h"

#include <algorithm>
#include <array>
#include <bit>
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

// A row holds as much energy as the hinge that it stands for once that is folded by a right angle from where it is at
// ease, to the side to which its tips move more.
constexpr double fold = std::numbers::pi / 2;

// m/N, of a row whose tips move so far then.
double compliance_of(const BendLaw& law, float stiffness, float area, float edge_squared, double moved) {
    return static_cast<double>(law.compliance(stiffness, area, edge_squared)) * moved * moved / (fold * fold);
}

}  // namespace

RowList build_flexion(const RestShape& rest, const FlexionMaterial& material) {
    RowList rows = make_rows(ConstraintKind::flexion);
    if (material.model != BendModel::distance) return rows;
    const BendLaw law(material);
    rows.geometry_count = 5;
    for (const Hinge& hinge : rest.topology.hinges) {
        if (!bends(rest.topology, hinge, material.hinges)) continue;
        const HingeShape shape = shape_of(rest, hinge);
        const float stiffness = law.stiffness(shape.across);
        if (!(stiffness > 0)) {
            rows.left_out.push_back(shape.across);
            continue;
        }
        const Tips tips(rest.topology, hinge);
        const auto angle = static_cast<double>(angle_at_rest(rest.topology, hinge, material));
        const double apart = tips.apart(angle);
        const double moved =
            std::max(std::abs(apart - tips.apart(angle + fold)), std::abs(apart - tips.apart(angle - fold)));
        const double compliance = compliance_of(law, stiffness, shape.area, shape.edge_squared, moved);
        if (!(compliance > 0) || !std::isfinite(apart)) continue;
        const auto [low, high] = std::bit_cast<std::array<float, 2>>(moved);
        rows.add({hinge.c, hinge.d}, {static_cast<float>(apart), static_cast<float>(compliance)},
                 {shape.across, shape.area, shape.edge_squared, low, high});
    }
    return rows;
}

bool change_flexion(const RowsToChange& rows, const FlexionMaterial& material) {
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
