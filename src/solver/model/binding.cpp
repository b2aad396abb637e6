#include "solver/model/binding.h"

#include "mesh/weld.h"
#include "physics/scalar.h"

#include <algorithm>
#include <cstddef>

namespace weft {
namespace {

using scalar::FollowFrame;

scalar::vec3 spread(Vec3 v) {
    return {v.x, v.y, v.z};
}
Vec3 gathered(scalar::vec3 v) {
    return {v.x, v.y, v.z};
}
Vec3 to_local(const FollowFrame& frame, Vec3 v) {
    const scalar::vec3 all = spread(v);
    return {scalar::dot(frame.x, all), scalar::dot(frame.y, all), scalar::dot(frame.z, all)};
}

FollowFrame frame_at(const BoundVertex& vertex, std::span<const Vec4> positions, std::span<const Vec4> normals) {
    const auto corner = [&](std::size_t i) { return spread(positions[vertex.particles[i]].xyz()); };
    const auto normal = [&](std::size_t i) { return spread(normals[vertex.particles[i]].xyz()); };
    return scalar::follow_frame(corner(0), corner(1), corner(2), normal(0), normal(1), normal(2), vertex.weights[0],
                                vertex.weights[1]);
}

constexpr float least_square = 1e-30f;

std::vector<Vec3> area_weighted_normals(std::span<const Vec3> positions, std::span<const Triangle> triangles) {
    std::vector<Vec3> sums(positions.size());
    for (const auto& [a, b, c] : triangles) {
        const Vec3 n = cross(positions[b] - positions[a], positions[c] - positions[a]);
        for (const std::uint32_t corner : {a, b, c}) sums[corner] += n;
    }
    for (Vec3& n : sums) n = dot(n, n) > least_square ? normalized(n) : Vec3{};
    return sums;
}

// Normals of particles as defined in surface/normals.md.
std::vector<Vec3> smooth_normals(std::span<const Vec3> positions, std::span<const Triangle> triangles) {
    std::vector<Vec3> normals = area_weighted_normals(positions, triangles), sums(positions.size());
    for (Vec3& n : normals)
        if (n == Vec3{}) n = {0, 1, 0};
    for (const auto& [a, b, c] : triangles) {
        const Vec3 face = cross(positions[b] - positions[a], positions[c] - positions[a]);
        const Vec3 n =
            gathered(scalar::smooth_face(spread(face), spread(normals[a]), spread(normals[b]), spread(normals[c])));
        for (const std::uint32_t corner : {a, b, c}) sums[corner] += n;
    }
    for (Vec3& n : sums) n = dot(n, n) > least_square ? normalized(n) : Vec3{0, 1, 0};
    return sums;
}

}  // namespace

std::vector<Vec3> normals_to_draw(const TriangleMesh& mesh) {
    if (!mesh.normals.empty()) return mesh.normals;
    const Weld weld = weld_vertices(mesh.positions, 0);
    std::vector<Triangle> triangles = mesh.triangles;
    for (Triangle& t : triangles)
        for (std::uint32_t& corner : t) corner = weld.first_vertex[weld.vertex_to_welded[corner]];
    std::vector<Vec3> normals = area_weighted_normals(mesh.positions, triangles);
    for (std::size_t v = 0; v < normals.size(); ++v) normals[v] = normals[weld.first_vertex[weld.vertex_to_welded[v]]];
    return normals;
}

Binder::Binder(const Topology& topology) : topology_(topology), search_(topology.rest_positions, topology.triangles) {
    for (const Vec3 p : topology.rest_positions) positions_.push_back({p.x, p.y, p.z, 0});
    for (const Vec3 n : smooth_normals(topology.rest_positions, topology.triangles))
        normals_.push_back({n.x, n.y, n.z, 0});
}

BoundVertex Binder::bind(Vec3 position, Vec3 normal, std::uint32_t triangle,
                         const std::array<double, 3>& weights) const {
    BoundVertex vertex{.particles = topology_.triangles[triangle],
                       .weights = {static_cast<float>(weights[1]), static_cast<float>(weights[2])},
                       .offset = {},
                       .normal = {}};
    const FollowFrame frame = frame_at(vertex, positions_, normals_);
    vertex.offset = to_local(frame, position - gathered(frame.origin));
    const Vec3 local = to_local(frame, normal);
    vertex.normal = dot(local, local) > 0.25f ? normalized(local) : Vec3{0, 0, 1};
    return vertex;
}

double Binder::bind_to(std::uint32_t triangle, Vec3 position, Vec3 normal, BoundVertex& bound) const {
    const auto& [a, b, c] = topology_.triangles[triangle];
    const auto& at = topology_.rest_positions;
    const TrianglePoint point = closest_on_triangle(position, at[a], at[b], at[c]);
    bound = bind(position, normal, triangle, point.weights);
    return point.squared_distance;
}

Binding bind_mesh(const TriangleMesh& drawn, const Topology& topology) {
    const Binder binder(topology);
    const std::vector<Vec3> normals = normals_to_draw(drawn);
    Binding binding;
    std::vector<BoundVertex> vertices;
    vertices.reserve(drawn.positions.size());
    for (std::size_t v = 0; v < drawn.positions.size(); ++v) {
        const SurfacePoint point = binder.closest(drawn.positions[v]);
        vertices.push_back(binder.bind(drawn.positions[v], normals[v], point.triangle, point.weights));
        binding.farthest = std::max(binding.farthest, static_cast<float>(point.distance));
    }
    binding.vertices = std::move(vertices);
    return binding;
}

void follow(const Binding& binding, std::span<const Vec4> positions, std::span<const Vec4> normals,
            std::vector<Vec3>& drawn_positions, std::vector<Vec3>& drawn_normals) {
    drawn_positions.resize(binding.vertices.size());
    drawn_normals.resize(binding.vertices.size());
    for (std::size_t v = 0; v < binding.vertices.size(); ++v) {
        const BoundVertex& vertex = binding.vertices[v];
        const FollowFrame frame = frame_at(vertex, positions, normals);
        drawn_positions[v] = gathered(frame.origin + scalar::out_of(frame, spread(vertex.offset)));
        drawn_normals[v] = gathered(scalar::out_of(frame, spread(vertex.normal)));
    }
}

}  // namespace weft
