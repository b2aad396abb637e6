#include "weft/painting.h"

#include "scene/problems.h"
#include "scene/scene_keys.h"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <variant>

namespace weft {
namespace {

constexpr auto least_factor = static_cast<float>(one_factor.min);

float channel_of(Vec4 color, ColorChannel channel) {
    switch (channel) {
        case ColorChannel::red:
            return color.x;
        case ColorChannel::green:
            return color.y;
        case ColorChannel::blue:
            return color.z;
        case ColorChannel::alpha:
            return color.w;
    }
    return 1;
}

// The factor of each particle is the mean of its vertices.
Result<void> paint_channel(ColorChannel channel, float factor, const PinnedCloth& cloth, std::vector<float>& factors,
                           const std::string& place) {
    const auto& colors = cloth.mesh.colors;
    if (colors.empty()) return Error{place + "/channel", "the mesh has no vertex colors"};
    std::vector<float> sum(factors.size()), count(factors.size());
    for (std::size_t v = 0; v < colors.size(); ++v) {
        const std::uint32_t p = cloth.numbers.of_vertex[v];
        const float value = channel_of(colors[v], channel);
        if (p == none) continue;
        if (!std::isfinite(value))
            return Error{place + "/channel", "the color of vertex " + std::to_string(v) + " is not a finite number"};
        sum[p] += value, ++count[p];
    }
    for (std::size_t p = 0; p < sum.size(); ++p)
        if (count[p] > 0) factors[p] = std::max(least_factor, factor * sum[p] / count[p]);
    return {};
}

}  // namespace

ClothWeights::Factors ClothWeights::*factors_of(WeightOf of) {
    switch (of) {
        case WeightOf::density:
            return &ClothWeights::density;
        case WeightOf::stretch:
            return &ClothWeights::stretch;
        case WeightOf::bend:
            return &ClothWeights::bend;
        case WeightOf::thickness:
            break;
    }
    return &ClothWeights::thickness;
}

template <class Desc>
Result<void> paint_factors(const Desc& desc, const PinnedCloth& cloth, std::vector<float>& factors,
                           const std::string& place) {
    if (const auto* painted = std::get_if<PaintedChannel>(&desc.select))
        return paint_channel(painted->channel, desc.factor, cloth, factors, place);
    std::variant<VertexPins, BoxPins, ColorPins> select;
    std::visit(
        [&](const auto& one) {
            if constexpr (!std::is_same_v<std::remove_cvref_t<decltype(one)>, PaintedChannel>) select = one;
        },
        desc.select);
    const auto chosen = select_particles(select, cloth, place);
    if (!chosen) return chosen.errors();
    for (std::size_t i = 0; i < chosen->size(); ++i) {
        // Copies follow the listed vertices, and have no factors of their own.
        const float own = i < desc.factors.size() ? desc.factors[i] : 1;
        factors[(*chosen)[i]] = std::max(least_factor, desc.factor * own);
    }
    return {};
}

template Result<void> paint_factors(const ResistanceDesc&, const PinnedCloth&, std::vector<float>&, const std::string&);
template Result<void> paint_factors(const WeightDesc&, const PinnedCloth&, std::vector<float>&, const std::string&);

Result<ClothWeights> weights_of(std::span<const WeightDesc> weights, const PinnedCloth& cloth,
                                std::span<const Triangle> triangles, const std::string& place) {
    ClothWeights result;
    Errors errors;
    for (std::size_t i = 0; i < weights.size(); ++i) {
        std::vector<float>& factors = (result.*factors_of(weights[i].of)).of_particles;
        factors.resize(cloth.numbers.particle_count, 1.0f);
        if (const auto done = paint_factors(weights[i], cloth, factors, at(place, i)); !done)
            errors.insert(errors.end(), done.errors().begin(), done.errors().end());
    }
    if (!errors.empty()) return errors;
    for (ClothWeights::Factors* factors : {&result.density, &result.stretch, &result.bend, &result.thickness}) {
        const std::vector<float>& at_corner = factors->of_particles;
        if (at_corner.empty()) continue;
        factors->of_triangles.reserve(triangles.size());
        for (const auto& [a, b, c] : triangles)
            factors->of_triangles.push_back((at_corner[a] + at_corner[b] + at_corner[c]) / 3);
    }
    return result;
}

}  // namespace weft
