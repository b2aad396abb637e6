#include "physics/rest_shape.h"

#include "physics/rest_frames.h"

#include <algorithm>
#include <cmath>

namespace weft {
namespace {

Vec3 laid_into(Vec3 axis, Vec3 normal) {
    return axis - normal * dot(axis, normal);
}

Vec3 warp_without_uvs(Vec3 normal) {
    const Vec3 along_x = laid_into({1, 0, 0}, normal);
    return normalized(dot(along_x, along_x) > 0.01f ? along_x : laid_into({0, 0, 1}, normal));
}

// Direction in which u increases and v is constant; zero if the UVs span no area. Where v is constant along a side, the
// quotient is 0 or 1, and the result is the direction of that side, whatever the rounding of v.
Vec3 warp_from_uvs(Vec3 e1, Vec3 e2, Vec2 t1, Vec2 t2) {
    const float det = t1.x * t2.y - t2.x * t1.y;
    const float scale = std::abs(t1.x * t2.y) + std::abs(t2.x * t1.y);
    if (!(std::abs(det) > 1e-6f * scale)) return {};
    if (std::abs(t2.y) >= std::abs(t1.y))
        return normalized((e1 - e2 * (t1.y / t2.y)) * ((det > 0) == (t2.y > 0) ? 1.0f : -1.0f));
    return normalized((e1 * (t2.y / t1.y) - e2) * ((det > 0) == (t1.y > 0) ? 1.0f : -1.0f));
}

float cos2_at(const RestShape& rest, const Edge& edge) {
    const Vec3 along = normalized(rest.topology.rest_positions[edge.b] - rest.topology.rest_positions[edge.a]);
    float sum = 0, count = 0;
    for (std::uint32_t t : {edge.triangle0, edge.triangle1}) {
        if (t == none) continue;
        const float c = dot(along, rest.warp[t]);
        sum += c * c;
        count += 1;
    }
    return count > 0 ? std::min(1.0f, sum / count) : 1.0f;
}

float area_at(const RestShape& rest, const Edge& edge) {
    return (edge.triangle0 == none ? 0.0f : rest.area[edge.triangle0]) +
           (edge.triangle1 == none ? 0.0f : rest.area[edge.triangle1]);
}

void complete(RestShape& rest) {
    rest.frames = rest_frames(rest);
    rest.cos2_to_warp.reserve(rest.topology.edges.size());
    rest.area_at_edge.reserve(rest.topology.edges.size());
    for (const Edge& edge : rest.topology.edges) {
        rest.cos2_to_warp.push_back(cos2_at(rest, edge));
        rest.area_at_edge.push_back(area_at(rest, edge));
    }
}

}  // namespace

float weighted_area_at(const RestShape& rest, std::size_t edge, const std::vector<float>& weights) {
    if (weights.empty()) return rest.area_at_edge[edge];
    const Edge& at = rest.topology.edges[edge];
    float sum = 0;
    for (const std::uint32_t t : {at.triangle0, at.triangle1})
        if (t != none) sum += weights[t] * rest.area[t];
    return sum;
}

RestShape make_rest_shape(const TriangleMesh& mesh, const Topology& topology) {
    RestShape rest{.topology = topology, .area = {}, .warp = {}};
    rest.area.reserve(topology.triangles.size());
    rest.warp.reserve(topology.triangles.size());
    for (std::size_t t = 0; t < topology.triangles.size(); ++t) {
        const auto [a, b, c] = topology.triangles[t];
        const Vec3 e1 = topology.rest_positions[b] - topology.rest_positions[a];
        const Vec3 e2 = topology.rest_positions[c] - topology.rest_positions[a];
        const Vec3 n = cross(e1, e2);
        rest.area.push_back(
            area_of(topology.rest_positions[a], topology.rest_positions[b], topology.rest_positions[c]));

        Vec3 warp;
        if (!mesh.uvs.empty()) {
            const auto [va, vb, vc] = mesh.triangles[topology.source_triangle[t]];
            // The render triangle has the corners of the simulated one in the same order, and the UVs of its side of a
            // seam.
            warp = warp_from_uvs(e1, e2, mesh.uvs[vb] - mesh.uvs[va], mesh.uvs[vc] - mesh.uvs[va]);
        }
        if (!(dot(warp, warp) > 0.5f)) warp = warp_without_uvs(normalized(n));
        rest.warp.push_back(warp);
    }
    complete(rest);
    return rest;
}

RestShape make_rest_shape(const Topology& topology, std::vector<float> area, std::vector<Vec3> warp) {
    RestShape rest{.topology = topology, .area = std::move(area), .warp = std::move(warp)};
    complete(rest);
    return rest;
}

}  // namespace weft
