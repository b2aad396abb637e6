#include "solver/measures/measures.h"
#include "view/nice_numbers.h"
#include "view/overlay_parts.h"

#include <cmath>

namespace weft::overlay {
namespace {

// %. Lower bound for the end of the scale, because a smaller scale would show noise.
constexpr double least_scale_of_strain = 0.5;

// %: per particle, mean over its stretch constraints, positive if longer than at rest.
std::vector<float> strain_of(const ClothFrame& cloth) {
    const ConstraintTable& table = cloth.model->table(ConstraintKind::stretch);
    ParticleMeans means(cloth.model->particle_count);
    for (std::uint32_t row = 0; row < table.stride; ++row) {
        if (!table.is_real(row)) continue;
        const std::uint32_t a = table.particles[row], b = table.particles[std::size_t{table.stride} + row];
        const double rest = table.fields[row];
        const double strain = 100 * (distance(cloth.positions[a].xyz(), cloth.positions[b].xyz()) / rest - 1);
        if (!std::isfinite(strain)) continue;
        means.add(a, strain);
        means.add(b, strain);
    }
    return means.result();
}

}  // namespace

void strain(const OverlayInput& input, OverlayOutput& output) {
    std::vector<float> sizes;
    for (const ClothFrame& cloth : input.frame.cloths) {
        const std::vector<float> values = strain_of(cloth);
        for (const float value : values) sizes.push_back(std::abs(value));
        output.scalars.push_back({.values = at_vertices(*cloth.model, values)});
    }
    if (output.scalars.empty()) return;
    const auto most =
        static_cast<float>(std::max(least_scale_of_strain, nice_above(std::max(percentile(sizes, 0.98), 1e-9))));
    for (Scalars& scalars : output.scalars) {
        scalars.least = -most, scalars.most = most;
        scalars.scale = render::ColorScale::balance;
    }
    output.legends.push_back(
        {.title = "strain, %", .bar = Legend::Bar{-most, most, render::ColorScale::balance}, .of_scalars = true});
}

}  // namespace weft::overlay
