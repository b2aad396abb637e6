#include "solver/measures/residual.h"

#include "physics/scalar.h"
#include "solver/measures/measures.h"

#include <cmath>

namespace weft {

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
        const double longer = static_cast<double>(length(a - b)) - rest;
        const auto [c, share] = reference::stretch_spring(longer, table.fields[std::size_t{3} * table.stride + row]);
        const double compliance = table.fields[(c > 0 ? 1 : 2) * std::size_t{table.stride} + row] * share;
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
