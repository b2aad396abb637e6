#include "physics/bend/hinge_at_rest.h"
#include "physics/change_rows.h"

#include <algorithm>
#include <array>

namespace weft {

RowList build_bend(const RestShape& rest, const BendMaterial& material) {
    RowList rows = make_rows(ConstraintKind::bend);
    if (material.model != BendModel::dihedral) return rows;
    rows.geometry_count = 2;
    for_each_stiff_hinge(rest, material, rows, [&](const Hinge& hinge, const HingeShape& shape, float stiffness) {
        rows.add({hinge.a, hinge.b, hinge.c, hinge.d},
                 {angle_at_rest(rest.topology, hinge, material),
                  BendLaw::compliance(stiffness, shape.area, shape.edge_squared)},
                 {shape.across, shape.area});
    });
    return rows;
}

bool change_bend(const RowsToChange& rows, const BendMaterial& material) {
    const BendLaw law(material);
    for (const float across : rows.left_out)
        if (law.stiffness(across) > 0) return false;
    // Edge lengths are gathered from all over the cloth in a separate loop, so that the main loop vectorizes.
    constexpr std::uint32_t some = 512;
    std::array<float, some> edge_squared;
    int without = 0;
    for (std::uint32_t begin = 0; begin < rows.stride; begin += some) {
        const std::uint32_t count = std::min(some, rows.stride - begin);
        for (std::uint32_t i = 0; i < count; ++i) {
            const std::uint32_t a = rows.particles[begin + i], b = rows.particles[rows.stride + begin + i];
            const Vec3 e = rows.rest_positions[b].xyz() - rows.rest_positions[a].xyz();
            edge_squared[i] = dot(e, e);
        }
        const float* __restrict across = rows.geometry + begin;
        const float* __restrict area = across + rows.stride;
        float* __restrict compliance = rows.fields + rows.stride + begin;
        for (std::uint32_t i = 0; i < count; ++i) {
            const float stiffness = law.stiffness(across[i]);
            const float value = BendLaw::compliance(stiffness, area[i], edge_squared[i]);
            const bool real = !(area[i] < 0);
            without |= static_cast<int>(real) & static_cast<int>(!(stiffness > 0));
            compliance[i] = real ? value : compliance[i];
        }
    }
    return without == 0;
}

}  // namespace weft
