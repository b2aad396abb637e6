#include "solver/model/masses.h"

#include "scene/problems.h"

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace weft {
namespace {

bool has_inverse(float mass) {
    const float weight = 1 / mass;
    return weight > 0 && weight <= std::numeric_limits<float>::max();
}

}  // namespace

AlignedVector<float> lump_masses(std::span<const float> face_area, const TriangleView& triangles,
                                 std::uint32_t particle_count, float density, std::span<const float> weights) {
    std::vector<double> sum(particle_count);
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
        double third = static_cast<double>(density) * face_area[t] / 3;
        if (!weights.empty()) third *= double{weights[t]};
        for (const std::uint32_t p : triangles[t]) sum[p] += third;
    }
    AlignedVector<float> mass(particle_count);
    for (std::uint32_t p = 0; p < particle_count; ++p) mass[p] = static_cast<float>(sum[p]);
    return mass;
}

Result<void> check_density(float density) {
    if (density > 0 && std::isfinite(density)) return {};
    return Error{"density", "must be > 0 kg/m², got " + number_text(density)};
}

Result<void> check_masses(std::span<const float> mass) {
    int without = 0;
    for (const float one : mass) without |= static_cast<int>(!has_inverse(one));
    if (without == 0) return {};
    std::size_t p = 0;
    while (has_inverse(mass[p])) ++p;
    return Error{"particle " + std::to_string(p),
                 "its mass of " + number_text(mass[p]) + " kg has no finite inverse in single precision"};
}

}  // namespace weft
