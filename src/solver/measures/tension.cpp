#include "solver/measures/tension.h"

#include "solver/measures/measures.h"

#include <algorithm>
#include <cmath>

namespace weft {
namespace {

using reference::vec3;

// A strain limit below this would be within the rounding of positions.
constexpr double least_strain_limit = 1e-4;

vec3 place(const Vec4& p) {
    return vec3(p.x, p.y, p.z);
}

struct Averages {
    std::vector<reference::PlaneStress> stress;  // sums, weighted by area
    std::vector<double> ratio;                   // largest strain of the sides over its limit
};

reference::TearCoupling coupling_of(const StressTable::Face& face) {
    const SymmetricMatrix& q = face.coupling;
    return {.ab = q[0][0], .bc = q[1][1], .ca = q[2][2], .ab_bc = q[0][1], .bc_ca = q[1][2], .ca_ab = q[2][0]};
}

reference::PlaneStress stress_of(const StressTable& table, const StressTable::Face& face, const vec3 (&x)[3]) {
    const auto& [ab, bc, ca] = face.sides;
    const reference::TearFlat flat = reference::lay_flat(x[0], x[1], x[2], ab, bc);
    const reference::PlaneStress springs = reference::springs_stress(flat, ab, bc, ca);
    if (!table.membranes) return springs;
    return reference::add_stress(springs, reference::coupling_stress(flat, ab, bc, ca, coupling_of(face)), 1);
}

Averages gather(const StressTable& table, std::span<const Vec4> positions) {
    const std::size_t count = table.area.size();
    Averages sums{std::vector<reference::PlaneStress>(count, reference::no_stress()), std::vector<double>(count)};
    const double limit = table.tear_ratio > 0 ? std::max(table.tear_ratio - 1, least_strain_limit) : 0;
    for (const StressTable::Face& face : table.faces) {
        const vec3 x[3] = {place(positions[face.corners[0]]), place(positions[face.corners[1]]),
                           place(positions[face.corners[2]])};
        const reference::PlaneStress stress = stress_of(table, face, x);
        for (std::size_t k = 0; k < 3; ++k) {
            reference::PlaneStress& sum = sums.stress[face.corners[k]];
            const auto& [c2, s2] = face.turns[k];
            sum = reference::add_stress(sum, reference::turn_stress(stress, c2, s2), face.area);
            if (limit == 0) continue;
            const double part = reference::side_strain(x[k], x[(k + 1) % 3], face.sides[k]) / limit;
            for (const std::uint32_t p : {face.corners[k], face.corners[(k + 1) % 3]})
                sums.ratio[p] = larger(sums.ratio[p], part);
        }
    }
    return sums;
}

// N/m, of the triangles around each particle that ends a cut, in the direction of its tension.
std::vector<double> stiffness_at_cut_ends(const StressTable& table, std::span<const reference::Tension> tensions) {
    std::vector<double> stiffness(table.area.size());
    for (const StressTable::Face& face : table.faces) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t p = face.corners[k];
            if (!(table.cut_end[p] > 0)) continue;
            const auto& [c2, s2] = face.turns[k];
            const auto& [ab, bc, ca] = face.sides;
            const double x = tensions[p].x, y = tensions[p].y;
            double here = reference::coupling_stiffness(ab, bc, ca, coupling_of(face), c2, s2, x, y);
            for (const reference::TearSide& side : face.sides) here += reference::side_stiffness(side, c2, s2, x, y);
            stiffness[p] += here * face.area / table.area[p];
        }
    }
    return stiffness;
}

// 1 / limit of each seam's edges, m/N. Several edges of seams at the end of a cut take one round each.
std::vector<double> inverse_limits_of_seams(const StressTable& table) {
    std::vector<double> inverse;
    for (const StressTable::Seam& seam : table.seams) inverse.push_back(seam.inverse_strength);
    std::vector<std::uint32_t> left;
    for (std::uint32_t i = 0; i < table.seams.size(); ++i)
        if (table.cut_end[table.seams[i].particle] > 0 && table.seams[i].tear_energy > 0) left.push_back(i);
    while (!left.empty()) {
        std::vector<reference::Tension> across(table.area.size());
        std::vector<std::uint32_t> now, later;
        for (const std::uint32_t i : left) {
            reference::Tension& direction = across[table.seams[i].particle];
            const bool taken = direction.x != 0 || direction.y != 0;
            (taken ? later : now).push_back(i);
            if (!taken) direction.x = table.seams[i].x, direction.y = table.seams[i].y;
        }
        const std::vector<double> stiffness = stiffness_at_cut_ends(table, across);
        for (const std::uint32_t i : now) {
            const std::uint32_t p = table.seams[i].particle;
            inverse[i] = reference::inverse_cut_limit(stiffness[p], table.cut_end[p], table.seams[i].tear_energy);
        }
        left = std::move(later);
    }
    return inverse;
}

// The load across seams, where it exceeds that of the fabric.
void add_seams(const StressTable& table, std::span<const reference::PlaneStress> sums, std::vector<double>& load) {
    if (table.seams.empty()) return;
    const std::vector<double> inverse = inverse_limits_of_seams(table);
    for (std::size_t i = 0; i < table.seams.size(); ++i) {
        const auto& [p, x, y, strength, energy] = table.seams[i];
        if (!(table.area[p] > 0)) continue;
        const auto stress = reference::add_stress(reference::no_stress(), sums[p], 1 / table.area[p]);
        const double across = stress.mean + stress.difference * (x * x - y * y) + stress.mixed * 2 * x * y;
        load[p] = larger(load[p], larger(0, across) * inverse[i]);
    }
}

void keep_larger(std::optional<TensionSummary::Place>& most, std::span<const double> values, std::uint32_t cloth) {
    for (std::uint32_t p = 0; p < values.size(); ++p) {
        const bool first_nan = std::isnan(values[p]) && !(most && std::isnan(most->value));
        if (!most || values[p] > most->value || first_nan) most = {values[p], {cloth, p}};
    }
}

}  // namespace

bool has_limit(const StressTable& table) {
    const bool of_tension = table.inverse_strength[0] > 0 || table.inverse_strength[1] > 0 || table.tear_energy > 0;
    return table.tear_ratio > 0 || ((of_tension || !table.seams.empty()) && !table.inextensible);
}

namespace {

// Tension of each particle, and its part of the load.
void add_tensions(const StressTable& table, std::span<const reference::PlaneStress> sums, ClothTension& result) {
    const std::size_t count = table.area.size();
    std::vector<reference::Tension> tensions(count);
    for (std::size_t p = 0; p < count; ++p) {
        if (!(table.area[p] > 0)) continue;
        tensions[p] =
            reference::principal_tension(reference::add_stress(reference::no_stress(), sums[p], 1 / table.area[p]));
        result.tension[p] = larger(0, tensions[p].most);
    }
    const std::vector<double> stiffness = stiffness_at_cut_ends(table, tensions);
    for (std::size_t p = 0; p < count; ++p) {
        const reference::Tension& t = tensions[p];
        const bool cut = table.cut_end[p] > 0 && table.tear_energy > 0;
        const double inverse =
            cut ? reference::inverse_cut_limit(stiffness[p], table.cut_end[p], table.tear_energy)
                : reference::inverse_strength(t.x, t.y, table.inverse_strength[0], table.inverse_strength[1]);
        result.load[p] = larger(result.load[p], result.tension[p] * inverse);
    }
}

}  // namespace

ClothTension measure_tension(const StressTable& table, std::span<const Vec4> positions) {
    ClothTension result{std::vector<double>(table.area.size()), {}};
    Averages sums = gather(table, positions);
    result.load = std::move(sums.ratio);
    if (!table.inextensible) {
        add_tensions(table, sums.stress, result);
        add_seams(table, sums.stress, result.load);
    }
    for (std::size_t p = 0; p < table.inverse_resistance.size(); ++p) result.load[p] *= table.inverse_resistance[p];
    return result;
}

TensionSummary TensionMeter::measure(const Frame& frame) {
    TensionSummary summary;
    double sum = 0, area = 0;
    entries_.resize(frame.cloths.size());
    for (std::uint32_t i = 0; i < frame.cloths.size(); ++i) {
        const ClothFrame& cloth = frame.cloths[i];
        Entry& entry = entries_[i];
        const ClothModel& model = *cloth.model;
        if (entry.topology_version != cloth.topology_version || entry.particle_count != model.particle_count ||
            !(entry.fabric == model.fabric) || entry.weights != model.weights || entry.paint != model.tear_paint)
            entry = {make_stress_table(model, cloth.triangles),
                     model.fabric,
                     model.weights,
                     model.tear_paint,
                     cloth.topology_version,
                     model.particle_count};
        const ClothTension of_cloth = measure_tension(entry.table, cloth.positions);
        if (has_limit(entry.table)) keep_larger(summary.load, of_cloth.load, i);
        if (entry.table.inextensible) continue;
        keep_larger(summary.most, of_cloth.tension, i);
        for (std::size_t p = 0; p < of_cloth.tension.size(); ++p) {
            sum += of_cloth.tension[p] * entry.table.area[p];
            area += entry.table.area[p];
        }
    }
    if (summary.most) summary.mean = area > 0 ? sum / area : 0;
    return summary;
}

}  // namespace weft
