#include "solver/plan/tension.h"

#include "physics/stretch/stretch_law.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace weft {
namespace {

// Bins of strain, four per doubling; the first one holds all strains below `least`. They are found by exponent and
// thresholds, because logarithms of math libraries round differently on different machines.
constexpr int bins_per_doubling = 4;
constexpr std::array<double, bins_per_doubling> bin_starts{1, 1.189207115002721, 1.4142135623730951, 1.681792830507429};
constexpr double least = 1e-5, most = 100;  // the last bin begins at 9
constexpr std::size_t bin_count = 80;

std::size_t bin_of(double strain) {
    if (!(strain > least)) return 0;
    if (!(strain < most)) return bin_count - 1;
    int exponent = 0;
    const double mantissa = 2 * std::frexp(strain / least, &exponent);  // 1 to 2
    std::size_t part = bins_per_doubling - 1;
    while (mantissa < bin_starts[part]) --part;
    return std::min(1 + bins_per_doubling * static_cast<std::size_t>(exponent - 1) + part, bin_count - 1);
}

double start_of(std::size_t bin) {
    const int steps = static_cast<int>(bin) - 1;
    return least *
           std::ldexp(bin_starts[static_cast<std::size_t>(steps % bins_per_doubling)], steps / bins_per_doubling);
}

}  // namespace

float tension_in(const ConstraintTable& stretch, std::span<const float> lambda, double substep_seconds,
                 const Fabric& fabric) {
    const double softest = std::min(fabric.stretch.stretch[0], fabric.stretch.stretch[1]);
    if (fabric.stretch.inextensible || !(softest > 0) || !(substep_seconds > 0) || lambda.empty()) return 0;
    // A constraint represents a strip about as wide as it is long, so its force divided by its length is a tension per
    // width, of its spring alone. The strain is that of the whole fabric. Strains are counted in bins, which gives the
    // same bits in every order.
    std::array<std::uint32_t, bin_count> bins{};
    std::uint32_t count = 0;
    const double scale = -1 / (substep_seconds * substep_seconds * StretchLaw(fabric.stretch).softest_spring());
    for (std::uint32_t begin = 0; begin < stretch.stride; begin += 4 * lane_padding) {
        for (std::uint32_t row = begin; row < begin + lane_padding; ++row) {
            if (!stretch.is_real(row)) continue;
            const double strain = scale * static_cast<double>(lambda[row]) / static_cast<double>(stretch.fields[row]);
            ++count;
            ++bins[bin_of(strain)];
        }
    }
    std::uint32_t above = 0;
    std::size_t bin = bins.size();
    while (bin > 1 && 20 * (above + bins[bin - 1]) <= count) above += bins[--bin];
    // The upper end of the bin.
    const double strain = bin <= 1 ? 0 : start_of(bin);
    // At a large stretch, threads that turn toward the pull carry load too, and limits must not take it.
    return static_cast<float>(strain * (1 + strain) * softest);
}

}  // namespace weft
