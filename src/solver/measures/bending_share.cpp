#include "solver/measures/bending_share.h"

#include "physics/scalar.h"

#include <algorithm>

namespace weft {
namespace {

// 1/(N m)
struct Compliance {
    double at_once = 0, total = 0;
};

Compliance compliance_of(const ConstraintTable& table, std::uint32_t row) {
    const auto field = [&](std::size_t number) { return double{table.fields[number * table.stride + row]}; };
    if (table.kind == ConstraintKind::moment) return {field(1) + field(2), field(3)};
    return {field(1), field(1)};
}

// The least compliance that the first sweep of a substep leaves a constraint of weight 1, times 1/h2.
constexpr double least_compliance = 0.8 - WEFT_UNDONE_BY_FIRST_SWEEP;

}  // namespace

double bending_share(const ClothModel& model, std::span<const Vec4> positions, double substep_seconds) {
    const double h2 = substep_seconds * substep_seconds;
    double all = 0, left = 0;
    for (const ConstraintKind kind : {ConstraintKind::bend, ConstraintKind::moment}) {
        const ConstraintTable& table = model.table(kind);
        for (std::uint32_t row = 0; row < table.stride; ++row) {
            if (!table.is_real(row)) continue;
            scalar::vec3 x[4];
            float w[4];
            for (std::size_t k = 0; k < 4; ++k) {
                const Vec4 point = positions[table.particles[k * table.stride + row]];
                x[k] = scalar::vec3(point.x, point.y, point.z);
                w[k] = point.w;
            }
            const scalar::HingeAngle hinge = scalar::hinge_angle(x[0], x[1], x[2], x[3]);
            if (!hinge.able) continue;
            const double weight = double{scalar::hinge_weight(hinge, w[0], w[1], w[2], w[3])};
            const Compliance compliance = compliance_of(table, row);
            if (weight == 0 || !(compliance.total > 0)) continue;
            const double swept = compliance.total + std::max(0.0, least_compliance * weight * h2 - compliance.at_once);
            all += compliance.total;
            left += compliance.total * compliance.total / swept;
        }
    }
    return all > 0 ? left / all : 1;
}

}  // namespace weft
