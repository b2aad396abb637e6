#include "solver/plan/tension.h"

#include "physics/stretch/stretch_law.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

namespace weft {
namespace {

// Bins of strain, four per doubling; the first one holds all strains below `least`. They are found by exponent and
// thresholds, because logarithms of math libraries round differently on different machines. All numbers are floats, as
// on a GPU (vulkan/shaders/limits.glsl).
constexpr std::uint32_t bins_per_doubling = 4;
constexpr std::array<float, bins_per_doubling> bin_starts{1, 1.18920712f, 1.41421356f, 1.68179283f};
constexpr float least = 1e-5f, most = 100;  // the last bin begins at 9
constexpr std::uint32_t bin_count = 80;
constexpr std::uint32_t mantissa_bits = 23;
constexpr auto stiffness_of_straight = static_cast<float>(WEFT_STRAIGHT_STIFFNESS);
constexpr auto no_straight_strain = static_cast<float>(WEFT_NEVER_STRAIGHT);

std::uint32_t bin_of(float strain) {
    if (!(strain > least)) return 0;
    if (!(strain < most)) return bin_count - 1;
    const auto bits = std::bit_cast<std::uint32_t>(std::max(strain / least, 1.0f));
    const auto mantissa = std::bit_cast<float>((bits & 0x7fffffu) | 0x3f800000u);  // 1 to 2
    std::uint32_t part = bins_per_doubling - 1;
    while (mantissa < bin_starts[part]) --part;
    return std::min(1 + bins_per_doubling * ((bits >> mantissa_bits) - 127) + part, bin_count - 1);
}

float start_of(std::uint32_t bin) {
    const std::uint32_t steps = bin - 1;
    return least * bin_starts[steps % bins_per_doubling] *
           std::bit_cast<float>((127 + steps / bins_per_doubling) << mantissa_bits);
}

}  // namespace

float straight_strain(const StretchMaterial& material) {
    const float both = std::min(material.stretch_limit[0], material.stretch_limit[1]);
    return both > 0 ? std::max(material.stretch_limit[0], material.stretch_limit[1]) : no_straight_strain;
}

float tension_in(const ConstraintTable& stretch, std::span<const float> lambda, double substep_seconds,
                 const StretchMaterial& material) {
    const double softest = std::min(material.stretch[0], material.stretch[1]);
    if (material.inextensible || !(softest > 0) || !(substep_seconds > 0) || lambda.empty()) return 0;
    // A constraint represents a strip about as wide as it is long, so its force divided by its length is a tension per
    // width, of its spring alone. The strain is that of the whole fabric. Strains are counted in bins, which gives the
    // same bits in every order.
    std::array<std::uint32_t, bin_count> bins{};
    std::uint32_t count = 0;
    const float* const compliances = stretch.fields.data() + stretch.stride;
    const auto scale =
        static_cast<float>(-1 / (substep_seconds * substep_seconds * StretchLaw(material).softest_spring()));
    for (std::uint32_t begin = 0; begin < stretch.stride; begin += 4 * lane_padding) {
        for (std::uint32_t row = begin; row < begin + lane_padding; ++row) {
            const bool stiff = !(compliances[row] < 0 && compliances[stretch.stride + row] < 0);
            if (!stiff || !stretch.is_real(row)) continue;
            const float strain = scale * lambda[row] / stretch.fields[row];
            ++count;
            ++bins[bin_of(strain)];
        }
    }
    std::uint32_t above = 0;
    std::uint32_t bin = bin_count;
    while (bin > 1 && 20 * (above + bins[bin - 1]) <= count) above += bins[--bin];
    // The upper end of the bin.
    const float strain = bin <= 1 ? 0 : start_of(bin);
    // At a large stretch, threads that turn toward the pull carry load too, and limits must not take it.
    const float straight = straight_strain(material);
    const float of_cloth = strain > straight ? straight + (strain - straight) / stiffness_of_straight : strain;
    return strain * (1 + of_cloth) * static_cast<float>(softest);
}

}  // namespace weft
