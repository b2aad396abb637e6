#include "solver/plan/tension.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace weft {

float tension_in(const ConstraintTable& stretch, std::span<const float> lambda, double substep_seconds,
                 const Fabric& fabric) {
    const double softest = std::min(fabric.stretch.stretch[0], fabric.stretch.stretch[1]);
    if (fabric.stretch.inextensible || !(softest > 0) || !(substep_seconds > 0) || lambda.empty()) return 0;
    // A row stands for a strip about as wide as it is long, so its tension over its length is a tension per width.
    // Counted in bins of the strain that it makes, as that gives the same bits in whatever order; the first holds all
    // that is below 1/1000.
    constexpr int bins_per_doubling = 4;
    constexpr double least = 1e-5;
    std::array<std::uint32_t, 80> bins{};
    std::uint32_t count = 0;
    const double scale = -1 / (substep_seconds * substep_seconds * softest);
    for (std::uint32_t begin = 0; begin < stretch.stride; begin += 4 * lane_padding) {
        for (std::uint32_t row = begin; row < begin + lane_padding; ++row) {
            if (!stretch.is_real(row)) continue;
            const double strain = scale * static_cast<double>(lambda[row]) / static_cast<double>(stretch.fields[row]);
            ++count;
            if (!(strain > least)) {
                ++bins[0];
                continue;
            }
            const double bin = 1 + std::floor(bins_per_doubling * std::log2(strain / least));
            ++bins[static_cast<std::size_t>(std::min(bin, static_cast<double>(bins.size() - 1)))];
        }
    }
    std::uint32_t above = 0;
    std::size_t bin = bins.size();
    while (bin > 1 && 20 * (above + bins[bin - 1]) <= count) above += bins[--bin];
    // The upper end of the bin.
    const double strain = bin <= 1 ? 0 : least * std::exp2(static_cast<double>(bin - 1) / bins_per_doubling);
    return static_cast<float>(strain * softest);
}

}  // namespace weft
