#include "physics/bend/hinge_at_rest.h"
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

// Whether corner `at` between `a` and `b` has 90°, within 1°.
bool is_right_angle(reference::vec3 at, reference::vec3 a, reference::vec3 b) {
    constexpr double sin2_1_degree = 3.0458649e-4;
    const reference::vec3 u = a - at, v = b - at;
    const double uv = reference::dot(u, v);
    return uv * uv <= sin2_1_degree * reference::dot(u, u) * reference::dot(v, v);
}

//      c---b     A modeler cuts a rectangle along either diagonal, and the cloth knows of neither: the edge a-b of such
//      a | / |     pair of triangles is no crease. A triangle has one right angle at most, so it loses one hinge at
//      most a---d     and what is left are whole rectangles.
bool cuts_a_rectangle(const Topology& topology, const Hinge& h) {
    constexpr float degree = static_cast<float>(std::numbers::pi / 180);
    const auto& x = topology.rest_positions;
    const reference::vec3 a = exact(x[h.a]), b = exact(x[h.b]), c = exact(x[h.c]), d = exact(x[h.d]);
    return is_right_angle(c, a, b) && is_right_angle(d, a, b) && is_right_angle(a, c, d) && is_right_angle(b, c, d) &&
           std::abs(mesh_angle(topology, h)) <= degree;
}

}  // namespace

bool bends(const Topology& topology, const Hinge& hinge, HingeChoice choice) {
    return choice != HingeChoice::source || !cuts_a_rectangle(topology, hinge);
}

HingeShape shape_of(const RestShape& rest, const Hinge& hinge) {
    const Vec3 e = rest.topology.rest_positions[hinge.b] - rest.topology.rest_positions[hinge.a];
    // The cloth curves across the edge: an edge along the weft bends the warp.
    return {1 - rest.cos2_to_warp[hinge.edge], rest.area_at_edge[hinge.edge], dot(e, e)};
}

float angle_at_rest(const Topology& topology, const Hinge& hinge, const BendMaterial& material) {
    return std::isnan(material.rest_angle) ? mesh_angle(topology, hinge)
                                           : material.rest_angle * static_cast<float>(std::numbers::pi / 180);
}

}  // namespace weft
