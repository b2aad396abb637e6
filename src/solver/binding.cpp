#include "solver/binding.h"

#include "collide/closest_point.h"
#include "mesh/weld.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace weft {
namespace {

struct LocalFrame {
    Vec3 origin, x, y, z;

    Vec3 to_world(Vec3 v) const { return x * v.x + y * v.y + z * v.z; }
    Vec3 to_local(Vec3 v) const { return {dot(x, v), dot(y, v), dot(z, v)}; }
};

// Of a vector that is known to have a length; one division instead of three, as this runs for every drawn vertex.
Vec3 unit(Vec3 v) {
    return v * (1 / std::sqrt(dot(v, v)));
}

// A unit vector across the unit vector `n`, toward `wish` as far as that goes.
Vec3 across(Vec3 n, Vec3 wish) {
    const Vec3 laid = wish - n * dot(wish, n);
    if (dot(laid, laid) > 1e-6f * dot(wish, wish)) return unit(laid);
    const Vec3 other = std::abs(n.x) < 0.7f ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    return unit(other - n * dot(other, n));
}

// Phong tessellation: the point of the flat triangle, moved toward its projections onto the tangent planes of the
// corners. Boubekeur and Alexa 2008. With half of the way a surface of constant curvature is met up to the second
// order (an arc of half-angle φ over a chord 2L rises by Lφ/2, the projections by Lφ), and neighbors meet along their
// common side, since there both depend on its two ends alone.
constexpr float phong_share = 0.5f;

LocalFrame frame_at(const BoundVertex& vertex, std::span<const Vec4> positions, std::span<const Vec4> normals) {
    const auto [wb, wc] = vertex.weights;
    const float weights[3] = {1 - wb - wc, wb, wc};
    Vec3 flat, normal;
    for (std::size_t i = 0; i < 3; ++i) {
        flat += positions[vertex.particles[i]].xyz() * weights[i];
        normal += normals[vertex.particles[i]].xyz() * weights[i];
    }
    LocalFrame frame;
    frame.origin = flat;
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 n = normals[vertex.particles[i]].xyz();
        frame.origin -= n * (phong_share * weights[i] * dot(flat - positions[vertex.particles[i]].xyz(), n));
    }
    // Normals that cancel leave no direction; any will do, as long as it is one.
    frame.z = dot(normal, normal) > 1e-12f ? unit(normal) : Vec3{0, 1, 0};
    frame.x = across(frame.z, positions[vertex.particles[1]].xyz() - positions[vertex.particles[0]].xyz());
    frame.y = cross(frame.z, frame.x);
    return frame;
}

// As surface/normals.md has them.
std::vector<Vec3> area_weighted_normals(std::span<const Vec3> positions, std::span<const Triangle> triangles) {
    std::vector<Vec3> sums(positions.size());
    for (const auto& [a, b, c] : triangles) {
        const Vec3 n = cross(positions[b] - positions[a], positions[c] - positions[a]);
        for (const std::uint32_t corner : {a, b, c}) sums[corner] += n;
    }
    for (Vec3& n : sums) n = dot(n, n) > 1e-30f ? normalized(n) : Vec3{};
    return sums;
}

// Smooth across seams: vertices in the same place share their normal. Zero where there is none.
std::vector<Vec3> normals_of(const TriangleMesh& mesh) {
    if (!mesh.normals.empty()) return mesh.normals;
    const Weld weld = weld_vertices(mesh.positions, 0);
    std::vector<Triangle> triangles = mesh.triangles;
    for (Triangle& t : triangles)
        for (std::uint32_t& corner : t) corner = weld.first_vertex[weld.vertex_to_welded[corner]];
    std::vector<Vec3> normals = area_weighted_normals(mesh.positions, triangles);
    for (std::size_t v = 0; v < normals.size(); ++v) normals[v] = normals[weld.first_vertex[weld.vertex_to_welded[v]]];
    return normals;
}

}  // namespace

Binding bind_mesh(const TriangleMesh& drawn, const Topology& topology) {
    std::vector<Vec4> positions, normals;
    for (const Vec3 p : topology.rest_positions) positions.push_back({p.x, p.y, p.z, 0});
    for (const Vec3 n : area_weighted_normals(topology.rest_positions, topology.triangles))
        normals.push_back(n == Vec3{} ? Vec4{0, 1, 0, 0} : Vec4{n.x, n.y, n.z, 0});
    const std::vector<Vec3> drawn_normals = normals_of(drawn);
    const SurfaceSearch search(topology.rest_positions, topology.triangles);

    Binding binding;
    binding.vertices.reserve(drawn.positions.size());
    for (std::size_t v = 0; v < drawn.positions.size(); ++v) {
        const SurfacePoint point = search.closest(drawn.positions[v]);
        BoundVertex vertex{.particles = topology.triangles[point.triangle],
                           .weights = {static_cast<float>(point.weights[1]), static_cast<float>(point.weights[2])},
                           .offset = {},
                           .normal = {}};
        const LocalFrame frame = frame_at(vertex, positions, normals);
        vertex.offset = frame.to_local(drawn.positions[v] - frame.origin);
        const Vec3 normal = frame.to_local(drawn_normals[v]);
        vertex.normal = dot(normal, normal) > 0.25f ? normalized(normal) : Vec3{0, 0, 1};
        binding.vertices.push_back(vertex);
        binding.farthest = std::max(binding.farthest, static_cast<float>(point.distance));
    }
    return binding;
}

void follow(const Binding& binding, std::span<const Vec4> positions, std::span<const Vec4> normals,
            std::vector<Vec3>& drawn_positions, std::vector<Vec3>& drawn_normals) {
    drawn_positions.resize(binding.vertices.size());
    drawn_normals.resize(binding.vertices.size());
    for (std::size_t v = 0; v < binding.vertices.size(); ++v) {
        const BoundVertex& vertex = binding.vertices[v];
        const LocalFrame frame = frame_at(vertex, positions, normals);
        drawn_positions[v] = frame.origin + frame.to_world(vertex.offset);
        drawn_normals[v] = frame.to_world(vertex.normal);
    }
}

}  // namespace weft
