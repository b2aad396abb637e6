#include "physics/bend/hinge_at_rest.h"
#include "physics/change_rows.h"
#include "physics/moment/coupled_hinges.h"

#include <algorithm>
#include <array>

namespace weft {
namespace {

constexpr std::size_t side_numbers = 6;
constexpr std::size_t moment_geometry = 2 * side_numbers;

/// The numbers of a constraint that depend on the material.
struct MomentNumbers {
    std::array<float, 3> fields{};  ///< compliance_c, compliance_d, total
    std::array<float, coupled_numbers> coupling{};
};

// `weights`: factors on the stiffness of both triangles.
MomentNumbers numbers_of(const std::array<HingeSide, 2>& sides, const SheetStiffness& stiffness,
                         const std::array<double, 2>& weights = {1, 1}) {
    MomentNumbers numbers;
    double total = 0, rate = 1;
    for (std::size_t s = 0; s < 2; ++s) {
        SideCompliance compliance = compliance_of(sides[s], stiffness);
        compliance.at_once /= weights[s], compliance.own /= weights[s];
        for (double& by : compliance.by) by /= weights[s];
        numbers.fields[s] = static_cast<float>(compliance.at_once);
        numbers.coupling[3 * s] = static_cast<float>(compliance.own);
        for (std::size_t k = 0; k < 2; ++k) numbers.coupling[3 * s + 1 + k] = static_cast<float>(compliance.by[k]);
        total += compliance.total();
        rate = std::min(rate, compliance.rate());  // the other triangle may be pinned
    }
    numbers.fields[2] = static_cast<float>(total);
    numbers.coupling[6] = static_cast<float>(rate);
    return numbers;
}

}  // namespace

RowList build_moment(const RestShape& rest, const MomentMaterial& material) {
    RowList rows = make_rows(ConstraintKind::moment);
    if (material.model != BendModel::moment) return rows;
    rows.geometry_count = moment_geometry;
    const SheetStiffness stiffness(material);
    if (stiffness.limp()) {
        rows.left_out.push_back(0);
        return rows;
    }
    std::vector<CoupledHinge> hinges = couple_hinges(rest);
    const auto weights_of = [&](std::size_t h) {
        const Hinge& hinge = rest.topology.hinges[h];
        return std::array{double{weight_at(rest.bend_weight, hinge.triangle0)},
                          double{weight_at(rest.bend_weight, hinge.triangle1)}};
    };
    std::vector<std::uint32_t> row_of(hinges.size(), none);
    std::uint32_t count = 0;
    for (std::size_t h = 0; h < hinges.size(); ++h)
        if (numbers_of(hinges[h].side, stiffness, weights_of(h)).fields[2] > 0) row_of[h] = count++;
    // A hinge between degenerate triangles has no constraint, so nothing is coupled with it.
    for (CoupledHinge& hinge : hinges)
        for (std::size_t s = 0; s < 2; ++s)
            for (std::size_t k = 0; k < 2; ++k)
                if (std::uint32_t& other = hinge.linked[s][k]; other != none && (other = row_of[other]) == none)
                    hinge.side[s].link[k] = 0;
    for (std::size_t h = 0; h < hinges.size(); ++h) {
        if (row_of[h] == none) continue;
        const Hinge& hinge = rest.topology.hinges[h];
        const auto& [fields, coupling] = numbers_of(hinges[h].side, stiffness, weights_of(h));
        rows.add({hinge.a, hinge.b, hinge.c, hinge.d},
                 {angle_at_rest(rest.topology, hinge, material), fields[0], fields[1], fields[2]});
        for (const HingeSide& side : hinges[h].side)
            rows.geometry.insert(rows.geometry.end(),
                                 {side.edge[0], side.edge[1], side.tip[0], side.tip[1], side.link[0], side.link[1]});
        for (const auto& linked : hinges[h].linked)
            rows.coupled.insert(rows.coupled.end(), linked.begin(), linked.end());
        rows.coupling.insert(rows.coupling.end(), coupling.begin(), coupling.end());
    }
    return rows;
}

bool change_moment(const RowsToChange& rows, const MomentMaterial& material) {
    const SheetStiffness stiffness(material);
    if (stiffness.limp() != !rows.left_out.empty()) return false;
    for (std::uint32_t row = 0; row < rows.stride; ++row) {
        const auto geometry = [&](std::size_t number) { return rows.geometry[number * rows.stride + row]; };
        std::array<HingeSide, 2> sides;
        for (std::size_t s = 0; s < 2; ++s) {
            const std::size_t first = s * side_numbers;
            sides[s] = {{geometry(first), geometry(first + 1)},
                        {geometry(first + 2), geometry(first + 3)},
                        {geometry(first + 4), geometry(first + 5)}};
        }
        const auto& [fields, coupling] = numbers_of(sides, stiffness);
        if (!(fields[2] > 0)) continue;  // padding
        for (std::size_t k = 0; k < fields.size(); ++k) rows.fields[(k + 1) * rows.stride + row] = fields[k];
        for (std::size_t k = 0; k < coupling.size(); ++k) rows.coupling[k * rows.stride + row] = coupling[k];
    }
    return true;
}

}  // namespace weft
