#include "solver/measures/measures.h"

#include <cmath>

namespace weft {
namespace {

double speed2(const Vec4& v) {
    return static_cast<double>(v.x) * v.x + static_cast<double>(v.y) * v.y + static_cast<double>(v.z) * v.z;
}

// Calls visit(strain, axial) for each edge; `axial`: along warp or weft.
template <class Visit>
void for_each_strain(const ClothModel& model, std::span<const Vec4> positions, Visit&& visit) {
    for_each_edge(model, [&](const EdgeEnds& ends, bool axial) {
        const auto [a, b] = ends;
        const double rest = distance(model.rest_position(a), model.rest_position(b));
        if (rest <= 0) return;
        const double now = distance(positions[a].xyz(), positions[b].xyz());
        visit(std::abs(now / rest - 1), axial);
    });
}

}  // namespace

double distance(Vec3 a, Vec3 b) {
    const double x = static_cast<double>(a.x) - b.x, y = static_cast<double>(a.y) - b.y,
                 z = static_cast<double>(a.z) - b.z;
    return std::sqrt(x * x + y * y + z * z);
}

void collect_stretch(const ClothModel& model, std::span<const Vec4> positions, std::vector<double>& out) {
    for_each_strain(model, positions, [&](double strain, bool axial) {
        if (axial) out.push_back(strain);
    });
}

void MeasureSums::add(const ClothModel& model, std::span<const Vec4> positions, std::span<const Vec4> velocities) {
    for_each_strain(model, positions, [&](double strain, bool axial) { (axial ? stretch : shear).add(strain); });
    for (std::uint32_t p = 0; p < model.particle_count; ++p) {
        const double v2 = speed2(velocities[p]);
        if (positions[p].w > 0) kinetic_energy += 0.5 * model.mass[p] * v2;
        max_speed2 = larger(max_speed2, v2);
        finite = finite && weft::finite(positions[p].xyz()) && weft::finite(velocities[p].xyz());
    }
}

void MeasureSums::add_residual(const ClothModel& model, const Residual& of_cloth) {
    const double rows = model.table(ConstraintKind::stretch).rows;
    residual.add(of_cloth.mean * rows, rows, of_cloth.max);
}

void MeasureSums::add(const MeasureSums& other) {
    stretch.add(other.stretch);
    shear.add(other.shear);
    residual.add(other.residual);
    kinetic_energy += other.kinetic_energy;
    max_speed2 = larger(max_speed2, other.max_speed2);
    finite = finite && other.finite;
}

ClothMeasures MeasureSums::result() const {
    const MeanMax left = residual.result();
    return {.strain = {stretch.result(), shear.result()},
            .residual = {left.mean, left.max},
            .kinetic_energy = kinetic_energy,
            .max_speed = std::sqrt(max_speed2),
            .finite = finite};
}

}  // namespace weft
