#include "solver/measures/residual.h"

#include "solver/measures/measures.h"

#include <cmath>

namespace weft {
namespace {

constexpr auto of_straight = static_cast<float>(WEFT_STRAIGHT_COMPLIANCE);

}  // namespace

Residual stretch_residual(const ClothModel& model, std::span<const Vec4> positions, std::span<const float> lambdas,
                          double substep_seconds) {
    const ConstraintTable& table = model.table(ConstraintKind::stretch);
    const double h2 = substep_seconds * substep_seconds;
    Residual residual;
    for (std::uint32_t row = 0; row < table.stride; ++row) {
        if (!table.is_real(row)) continue;
        const Vec3 a = positions[table.particles[row]].xyz();
        const Vec3 b = positions[table.particles[table.stride + row]].xyz();
        const double rest = table.fields[row];
        const double now = length(a - b), straight = table.fields[std::size_t{3} * table.stride + row];
        double c = now - rest, compliance = table.fields[(c > 0 ? 1 : 2) * std::size_t{table.stride} + row];
        if (now > straight) c -= (straight - rest) * double{1 - of_straight}, compliance *= double{of_straight};
        const double lambda = lambdas[row];
        // A negative compliance means no stiffness on this side, so no error.
        const double left = compliance < 0 ? 0 : std::abs(c + (h2 > 0 ? compliance / h2 * lambda : 0)) / rest;
        residual.mean += left;
        residual.max = larger(residual.max, left);
    }
    if (table.rows > 0) residual.mean /= table.rows;
    return residual;
}

}  // namespace weft
