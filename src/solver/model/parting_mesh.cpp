#include "solver/model/parting_mesh.h"

#include <algorithm>
#include <functional>
#include <tuple>
#include <utility>

namespace weft {
namespace {

struct LeavingCorner {
    std::uint32_t key, vertex, triangle, corner;
};

/// Appends the vertex `source` again.
void repeat_vertex(TriangleMesh& mesh, std::uint32_t source) {
    const auto repeat = [&](auto& values) {
        if (values.empty()) return;
        const auto value = values[source];
        values.push_back(value);
    };
    repeat(mesh.positions);
    repeat(mesh.uvs);
    repeat(mesh.colors);
}

/// Parts vertices whose corners have different keys. The corners with the lowest key keep the vertex. `key_of`: per
/// vertex; on entry the key of vertices without corners.
void part_vertices(TriangleMesh& mesh, const std::vector<Triangle>& keys, std::vector<std::uint32_t>& key_of) {
    std::vector<std::uint32_t> lowest(mesh.positions.size(), none);
    for (std::size_t t = 0; t < keys.size(); ++t)
        for (std::size_t k = 0; k < 3; ++k) {
            std::uint32_t& least = lowest[mesh.triangles[t][k]];
            least = std::min(least, keys[t][k]);
        }
    std::vector<LeavingCorner> leaving;
    for (std::uint32_t t = 0; t < keys.size(); ++t)
        for (std::uint32_t k = 0; k < 3; ++k) {
            const std::uint32_t vertex = mesh.triangles[t][k];
            if (keys[t][k] != lowest[vertex]) leaving.push_back({keys[t][k], vertex, t, k});
        }
    for (std::size_t v = 0; v < lowest.size(); ++v)
        if (lowest[v] != none) key_of[v] = lowest[v];
    std::ranges::sort(leaving, {},
                      [](const LeavingCorner& c) { return std::tuple(c.key, c.vertex, c.triangle, c.corner); });
    std::uint32_t key = none, vertex = none;
    for (const LeavingCorner& c : leaving) {
        if (c.key != key || c.vertex != vertex) {
            key = c.key, vertex = c.vertex;
            repeat_vertex(mesh, vertex);
            key_of.push_back(key);
        }
        mesh.triangles[c.triangle][c.corner] = static_cast<std::uint32_t>(mesh.positions.size() - 1);
    }
}

/// A copy of a particle appends at most one vertex for each vertex of the particle. Each appended vertex has a corner.
std::size_t most_appended_to(const TriangleMesh& mesh, const std::vector<std::uint32_t>& vertex_to_particle,
                             std::uint32_t room) {
    std::vector<std::uint32_t> corners(mesh.positions.size());
    for (const Triangle& triangle : mesh.triangles)
        for (const std::uint32_t vertex : triangle) ++corners[vertex];
    std::uint32_t particles = 0;
    for (const std::uint32_t particle : vertex_to_particle)
        if (particle != none) particles = std::max(particles, particle + 1);
    struct Gain {
        std::uint32_t vertices = 0, corners = 0;
    };
    std::vector<Gain> gains(particles);
    for (std::size_t v = 0; v < corners.size(); ++v) {
        if (corners[v] == 0) continue;
        Gain& gain = gains[vertex_to_particle[v]];
        ++gain.vertices;
        gain.corners += corners[v];
    }
    std::ranges::sort(gains, std::greater<>(), &Gain::vertices);
    std::size_t most = 0;
    for (const Gain& gain : gains) {
        if (room == 0 || gain.vertices == 0) break;
        const std::uint32_t spare = gain.corners - gain.vertices;
        const std::uint32_t copies = std::min(room, (spare + gain.vertices - 1) / gain.vertices);
        most += std::size_t{copies} * gain.vertices;
        room -= copies;
    }
    return most;
}

}  // namespace

PartingMesh::PartingMesh(TriangleMesh mesh, std::vector<std::uint32_t> vertex_to_particle, std::uint32_t room)
    : mesh_(std::move(mesh)), vertex_to_particle_(std::move(vertex_to_particle)) {
    mesh_.normals = {};
    most_appended_ = most_appended_to(mesh_, vertex_to_particle_, room);
}

PartingMesh::Parted PartingMesh::parted(TriangleView triangles) const {
    Parted now{mesh_, vertex_to_particle_};
    std::vector<Triangle> particles;
    particles.reserve(triangles.size());
    for (std::uint32_t t = 0; t < triangles.size(); ++t) particles.push_back(triangles[t]);
    part_vertices(now.mesh, particles, now.vertex_to_particle);
    return now;
}

}  // namespace weft
