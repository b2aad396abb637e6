#include "physics/constraint.h"

#include <algorithm>

namespace weft {
namespace {

struct Moduli {
    float warp, weft;
};

// The springs along warp and weft carry a uniaxial load together with the diagonals. Solving
//     k₁ + K_s k₂/(k₂ + K_s) = K_warp   and its mirror
// leaves to the springs what the diagonals do not carry. A fabric whose shear stiffness nearly equals a tensile one has
// no such split; its springs keep a twentieth.
Moduli without_shear(Moduli k, float shear) {
    Moduli spring = k;
    const auto carried = [shear](float other) { return other + shear > 0 ? shear * other / (other + shear) : 0.0f; };
    for (int i = 0; i < 64; ++i) {
        spring = {std::max(k.warp - carried(spring.weft), 0.05f * k.warp),
                  std::max(k.weft - carried(spring.warp), 0.05f * k.weft)};
    }
    return spring;
}

}  // namespace

RowList build_stretch(const RestShape& rest, const StretchMaterial& material) {
    const Moduli pull = without_shear({material.stretch[0], material.stretch[1]}, material.shear);
    const Moduli push = without_shear({material.compression[0], material.compression[1]}, material.shear);
    RowList rows = make_rows(ConstraintKind::stretch);
    for (std::size_t e = 0; e < rest.topology.edges.size(); ++e) {
        const Edge& edge = rest.topology.edges[e];
        const float length_at_rest =
            length(rest.topology.rest_positions[edge.b] - rest.topology.rest_positions[edge.a]);
        const float cos2 = rest.cos2_to_warp[e];
        const float strip = rest.area_at_edge[e] / (length_at_rest * length_at_rest);
        // A negative compliance says "no stiffness" to the kernel, which has no infinity.
        const auto compliance = [&](Moduli k) {
            if (material.inextensible) return 0.0f;
            const float stiffness = directional(k.warp, 4 * material.shear, k.weft, cos2);
            // A millionth is what rounding leaves of warp and weft in a diagonal of a fabric without shear stiffness.
            const bool none_to_speak_of = stiffness <= 1e-6f * std::max({k.warp, k.weft, material.shear});
            return none_to_speak_of ? -1.0f : 1 / (stiffness * strip);
        };
        const float stretched = compliance(pull), compressed = compliance(push);
        if (stretched < 0 && compressed < 0) continue;
        rows.add({edge.a, edge.b}, {length_at_rest, stretched, compressed});
    }
    return rows;
}

}  // namespace weft
