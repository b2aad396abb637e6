#include "physics/change_rows.h"
#include "physics/membrane/membrane_split.h"
#include "physics/stretch/stretch_law.h"

#include <algorithm>

namespace weft {
namespace {

struct Moduli {
    float warp, weft;
};

// The springs along warp and weft carry a uniaxial load together with the diagonals. Solving k₁ + K_s k₂/(k₂ + K_s) =
// K_warp   and its mirror gives the springs what the diagonals do not carry. If the shear stiffness nearly equals a
// tensile one, there is no such split; the springs then keep a twentieth.
Moduli without_shear(Moduli k, float shear) {
    Moduli spring = k;
    const auto carried = [shear](float other) { return other + shear > 0 ? shear * other / (other + shear) : 0.0f; };
    for (int i = 0; i < 64; ++i) {
        spring = {std::max(k.warp - carried(spring.weft), 0.05f * k.warp),
                  std::max(k.weft - carried(spring.warp), 0.05f * k.weft)};
    }
    return spring;
}

float inverse_or_0(float x) {
    return x > 0 ? 1 / x : 0.0f;
}

StretchLaw::Compliances compliances_of(double stretched, double compressed, double least) {
    const auto of = [least](double stiffness) { return stiffness > least ? static_cast<float>(1 / stiffness) : -1.0f; };
    return {of(stretched), of(compressed)};
}

// Stiffness up to this part of the largest one, in a triangle of the same weight, is rounding error.
constexpr double least_spring_part = 1e-6;

// Of every edge, its springs in the triangles at it.
std::vector<StretchLaw::Compliances> edges_of_membrane(const RestShape& rest, const StretchMaterial& material) {
    struct Sum {
        double stretched = 0, compressed = 0, weight = 0;  // weight: the larger one of its triangles
    };
    const Topology& topology = rest.topology;
    std::vector<Sum> sums(topology.edges.size());
    for (std::uint32_t t = 0; t < topology.triangles.size(); ++t) {
        const MembraneSplit split = split_membrane(rest, t, material);
        const double weight = weight_at(rest.stretch_weight, t);
        const Triangle& corners = topology.triangles[t];
        for (std::size_t i = 0; i < 3; ++i) {
            const auto [a, b] = std::minmax(corners[(i + 1) % 3], corners[(i + 2) % 3]);
            for (const std::uint32_t e : topology.particle_edges[a]) {
                if (topology.edges[e].a != a || topology.edges[e].b != b) continue;
                sums[e].stretched += split.stretched[i], sums[e].compressed += split.compressed[i];
                sums[e].weight = std::max(sums[e].weight, weight);
            }
        }
    }
    double most = 0;
    for (const Sum& sum : sums)
        if (sum.weight > 0) most = std::max({most, sum.stretched / sum.weight, sum.compressed / sum.weight});
    std::vector<StretchLaw::Compliances> compliances;
    compliances.reserve(sums.size());
    for (const Sum& sum : sums)
        compliances.push_back(compliances_of(sum.stretched, sum.compressed, least_spring_part * most * sum.weight));
    return compliances;
}

}  // namespace

std::vector<std::array<StretchLaw::Compliances, 3>> springs_of_membrane(const RestShape& rest,
                                                                        const StretchMaterial& material) {
    std::vector<MembraneSplit> splits;
    double most = 0;
    for (std::uint32_t t = 0; t < rest.topology.triangles.size(); ++t) {
        splits.push_back(split_membrane(rest, t, material));
        for (const auto& of : {splits.back().stretched, splits.back().compressed})
            most = std::max(most, std::ranges::max(of) / weight_at(rest.stretch_weight, t));
    }
    std::vector<std::array<StretchLaw::Compliances, 3>> springs(splits.size());
    for (std::size_t t = 0; t < splits.size(); ++t)
        for (std::size_t i = 0; i < 3; ++i)
            springs[t][i] = compliances_of(
                splits[t].stretched[i], splits[t].compressed[i],
                least_spring_part * most * weight_at(rest.stretch_weight, static_cast<std::uint32_t>(t)));
    return springs;
}

StretchLaw::Side StretchLaw::side_of(const float (&moduli)[2], float shear) {
    const Moduli k = without_shear({moduli[0], moduli[1]}, shear);
    // In a fabric without shear stiffness, rounding leaves up to a millionth of warp and weft in a diagonal.
    return {k.warp, k.weft, 1e-6f * std::max({k.warp, k.weft, shear})};
}

StretchLaw::StretchLaw(const StretchMaterial& material)
    : pull_(side_of(material.stretch, material.shear)),
      push_(side_of(material.compression, material.shear)),
      bias_(4 * material.shear),
      inverse_limit_{inverse_or_0(material.stretch_limit[0]), inverse_or_0(material.stretch_limit[1])},
      inextensible_(material.inextensible) {}

RowList build_stretch(const RestShape& rest, const StretchMaterial& material) {
    const StretchLaw law(material);
    RowList rows = make_rows(ConstraintKind::stretch);
    rows.geometry_count = 2;
    const bool membrane = has_membranes(material);
    const auto of_membrane = membrane ? edges_of_membrane(rest, material) : std::vector<StretchLaw::Compliances>();
    for (std::size_t e = 0; e < rest.topology.edges.size(); ++e) {
        const Edge& edge = rest.topology.edges[e];
        const float length_at_rest =
            length(rest.topology.rest_positions[edge.b] - rest.topology.rest_positions[edge.a]);
        const float cos2 = rest.cos2_to_warp[e];
        // Stiffness is proportional to the area, so weights become part of it.
        const float strip = weighted_area_at(rest, e, rest.stretch_weight) / (length_at_rest * length_at_rest);
        const StretchLaw::Compliances compliances = membrane ? of_membrane[e] : law.at(cos2, strip);
        if (compliances.none()) {
            rows.left_out.push_back(cos2);
            continue;
        }
        rows.add({edge.a, edge.b},
                 {length_at_rest, compliances.stretched, compliances.compressed, law.play(cos2, length_at_rest)},
                 {cos2, strip});
    }
    return rows;
}

bool change_stretch(const RowsToChange& rows, const StretchMaterial& material) {
    const StretchLaw law(material);
    for (const float cos2 : rows.left_out)
        if (!law.at(cos2, 1).none()) return false;
    const float* __restrict cos2 = rows.geometry;
    const float* __restrict strip = cos2 + rows.stride;
    float* __restrict stretched = rows.fields + rows.stride;
    float* __restrict compressed = stretched + rows.stride;
    float* __restrict play = compressed + rows.stride;
    int without = 0;
    for (std::uint32_t row = 0; row < rows.stride; ++row) {
        const StretchLaw::Compliances at = law.at(cos2[row], strip[row]);
        const bool real = !(strip[row] < 0);
        without |= static_cast<int>(real) & static_cast<int>(at.stretched < 0) & static_cast<int>(at.compressed < 0);
        stretched[row] = real ? at.stretched : stretched[row];
        compressed[row] = real ? at.compressed : compressed[row];
        play[row] = real ? law.play(cos2[row], rows.fields[row]) : play[row];
    }
    return without == 0;
}

}  // namespace weft
