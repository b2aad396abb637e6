#include "physics/bend/hinge_at_rest.h"
#include "physics/scalar.h"

#include <cmath>
#include <numbers>

namespace weft {
namespace {

float mesh_angle(const Topology& topology, const Hinge& h) {
    const auto& x = topology.rest_positions;
    return static_cast<float>(reference::hinge_angle(reference::to_double(x[h.a]), reference::to_double(x[h.b]),
                                                     reference::to_double(x[h.c]), reference::to_double(x[h.d]))
                                  .theta);
}

// Whether corner `at` between `a` and `b` has 90°, within 1°.
bool is_right_angle(reference::vec3 at, reference::vec3 a, reference::vec3 b) {
    constexpr double sin2_1_degree = 3.0458649e-4;
    const reference::vec3 u = a - at, v = b - at;
    const double uv = reference::dot(u, v);
    return uv * uv <= sin2_1_degree * reference::dot(u, u) * reference::dot(v, v);
}

//      c---b     A modeler may cut a rectangle along either diagonal; the cloth itself has no diagonal, so the edge a-b
//      | / |     of such a pair of triangles is no crease. A triangle has at most one right angle, so it loses at most
//      a---d     one hinge, and whole rectangles remain.
bool cuts_a_rectangle(const Topology& topology, const Hinge& h) {
    constexpr float degree = static_cast<float>(std::numbers::pi / 180);
    const auto& x = topology.rest_positions;
    const reference::vec3 a = reference::to_double(x[h.a]), b = reference::to_double(x[h.b]),
                          c = reference::to_double(x[h.c]), d = reference::to_double(x[h.d]);
    return is_right_angle(c, a, b) && is_right_angle(d, a, b) && is_right_angle(a, c, d) && is_right_angle(b, c, d) &&
           std::abs(mesh_angle(topology, h)) <= degree;
}

}  // namespace

bool bends(const Topology& topology, const Hinge& hinge, BendEdges choice) {
    return choice != BendEdges::no_diagonals || !cuts_a_rectangle(topology, hinge);
}

HingeShape shape_of(const RestShape& rest, const Hinge& hinge) {
    const Vec3 e = rest.topology.rest_positions[hinge.b] - rest.topology.rest_positions[hinge.a];
    // The cloth curves perpendicular to the edge: an edge along the weft bends the warp.
    float area = rest.area_at_edge[hinge.edge];
    // Compliance is proportional to the area, so weights become part of it.
    if (!rest.bend_weight.empty()) area *= area / weighted_area_at(rest, hinge.edge, rest.bend_weight);
    return {1 - rest.cos2_to_warp[hinge.edge], area, dot(e, e)};
}

float angle_at_rest(const Topology& topology, const Hinge& hinge, const BendMaterial& material) {
    return std::isnan(material.rest_angle) ? mesh_angle(topology, hinge)
                                           : material.rest_angle * static_cast<float>(std::numbers::pi / 180);
}

}  // namespace weft
