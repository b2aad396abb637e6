#include "physics/constraint.h"
#include "physics/scalar.h"

#include <cmath>
#include <numbers>

namespace weft {
namespace {

reference::vec3 exact(Vec3 p) {
    return {p.x, p.y, p.z};
}

float mesh_angle(const Topology& topology, const Hinge& h) {
    const auto& x = topology.rest_positions;
    return static_cast<float>(reference::hinge_angle(exact(x[h.a]), exact(x[h.b]), exact(x[h.c]), exact(x[h.d])).theta);
}

}  // namespace

RowList build_bend(const RestShape& rest, const BendMaterial& material) {
    const auto [warp, bias, weft] = material.bend;
    RowList rows = make_rows(ConstraintKind::bend);
    for (const Hinge& hinge : rest.topology.hinges) {
        const Edge& edge = rest.topology.edges[hinge.edge];
        // The cloth curves across the edge: an edge along the weft bends the warp.
        const float across = 1 - cos2_to_warp(rest, edge);
        const float stiffness = directional(warp, bias, weft, across);
        if (!(stiffness > 0)) continue;
        const Vec3 e = rest.topology.rest_positions[hinge.b] - rest.topology.rest_positions[hinge.a];
        const float angle = std::isnan(material.rest_angle)
                                ? mesh_angle(rest.topology, hinge)
                                : material.rest_angle * static_cast<float>(std::numbers::pi / 180);
        rows.add({hinge.a, hinge.b, hinge.c, hinge.d}, {angle, area_at(rest, edge) / (stiffness * dot(e, e))});
    }
    return rows;
}

}  // namespace weft
