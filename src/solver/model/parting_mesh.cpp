#include "solver/model/parting_mesh.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <span>
#include <tuple>
#include <utility>

namespace weft {
namespace {

constexpr Triangle no_keys{none, none, none};

/// A removed triangle has the same particle at all its corners.
bool is_removed(const Triangle& triangle) {
    return triangle[0] == triangle[1];
}

struct LeavingCorner {
    std::uint32_t vertex, key, triangle, corner;
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

/// Parts vertices whose corners have different keys. The first corner of a vertex, and those with the same key, keep
/// it. New vertices are in the order of the vertices that they repeat, then of their first corners: while no vertex is
/// added, triangles stay as they are. Triangles without keys, `no_keys`, are removed: all their corners become the
/// first one. `key_of`: per vertex; on entry the key of vertices without corners.
void part_vertices(TriangleMesh& mesh, const std::vector<Triangle>& keys, std::vector<std::uint32_t>& key_of) {
    std::vector<bool> has_corner(mesh.positions.size());
    std::vector<LeavingCorner> leaving;
    for (std::uint32_t t = 0; t < keys.size(); ++t) {
        if (keys[t] == no_keys) {
            mesh.triangles[t].fill(mesh.triangles[t][0]);
            continue;
        }
        for (std::uint32_t k = 0; k < 3; ++k) {
            const std::uint32_t vertex = mesh.triangles[t][k];
            if (!has_corner[vertex]) key_of[vertex] = keys[t][k];
            has_corner[vertex] = true;
            if (keys[t][k] != key_of[vertex]) leaving.push_back({vertex, keys[t][k], t, k});
        }
    }
    std::ranges::stable_sort(leaving, {}, [](const LeavingCorner& c) { return std::pair(c.vertex, c.key); });
    std::vector<std::span<const LeavingCorner>> groups;
    for (std::size_t begin = 0, end = 0; begin < leaving.size(); begin = end) {
        while (end < leaving.size() && leaving[end].vertex == leaving[begin].vertex &&
               leaving[end].key == leaving[begin].key)
            ++end;
        groups.push_back(std::span<const LeavingCorner>(leaving).subspan(begin, end - begin));
    }
    std::ranges::sort(groups, {}, [](std::span<const LeavingCorner> group) {
        return std::tuple(group[0].vertex, group[0].triangle, group[0].corner);
    });
    for (const std::span<const LeavingCorner> group : groups) {
        for (const LeavingCorner& c : group)
            mesh.triangles[c.triangle][c.corner] = static_cast<std::uint32_t>(mesh.positions.size());
        repeat_vertex(mesh, group[0].vertex);
        key_of.push_back(group[0].key);
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

PartingMesh::PartingMesh(ClippedMesh clipped, const Topology& topology) : mesh_(std::move(clipped.mesh)) {
    const std::vector<Vec3> normals = std::exchange(mesh_.normals, {});
    const Binder binder(topology);
    list_uses(clipped.triangle_of, binder);
    bind_uses(normals, binder);
    for (std::uint32_t first = 0; first < uses_.size();) {
        std::uint32_t last = first + 1;
        while (last < uses_.size() && uses_[last].vertex == uses_[first].vertex) ++last;
        if (last - first > 1) join(first, last, topology);
        first = last;
    }
    most_appended_ = uses_.size() - mesh_.positions.size();
}

void PartingMesh::list_uses(const std::vector<std::uint32_t>& triangle_of, const Binder& binder) {
    using VertexIn = std::pair<std::uint32_t, std::uint32_t>;
    std::vector<VertexIn> all;
    std::vector<bool> used(mesh_.positions.size());
    for (std::size_t t = 0; t < triangle_of.size(); ++t)
        for (const std::uint32_t vertex : mesh_.triangles[t]) {
            all.emplace_back(vertex, triangle_of[t]);
            used[vertex] = true;
        }
    for (std::uint32_t v = 0; v < used.size(); ++v)
        if (!used[v]) all.emplace_back(v, binder.closest(mesh_.positions[v]).triangle);
    std::ranges::sort(all);
    all.erase(std::ranges::unique(all).begin(), all.end());
    uses_.reserve(all.size());
    for (const auto& [vertex, triangle] : all) uses_.push_back({vertex, triangle, {}});
    use_of_corner_.reserve(triangle_of.size());
    for (std::size_t t = 0; t < triangle_of.size(); ++t) {
        Triangle& own = use_of_corner_.emplace_back();
        for (std::size_t k = 0; k < 3; ++k)
            own[k] = static_cast<std::uint32_t>(
                std::ranges::lower_bound(all, VertexIn{mesh_.triangles[t][k], triangle_of[t]}) - all.begin());
    }
}

void PartingMesh::bind_uses(const std::vector<Vec3>& normals, const Binder& binder) {
    std::vector<double> nearest(mesh_.positions.size(), std::numeric_limits<double>::infinity());
    for (Use& use : uses_) {
        const double d2 = binder.bind_to(use.triangle, mesh_.positions[use.vertex], normals[use.vertex], use.bound);
        nearest[use.vertex] = std::min(nearest[use.vertex], d2);
    }
    for (const double d2 : nearest) farthest_ = std::max(farthest_, static_cast<float>(std::sqrt(d2)));
}

// Two triangles that meet in an edge part when it opens. Several that meet in one corner part with its particle: there
// may be other triangles between them, over which nothing is drawn. Others never meet. They hang together for good,
// because a render mesh that lies over two layers of cloth would be torn from the start.
void PartingMesh::join(std::uint32_t first, std::uint32_t last, const Topology& topology) {
    const auto slot_of = [&](std::uint32_t use, std::uint32_t particle) {
        const Triangle& t = topology.triangles[uses_[use].triangle];
        return static_cast<std::uint32_t>(std::ranges::find(t, particle) - t.begin());
    };
    const auto pair_at = [&](std::uint32_t a, std::uint32_t b, std::uint32_t particle) {
        return std::array{Joint::Corner{uses_[a].triangle, slot_of(a, particle)},
                          Joint::Corner{uses_[b].triangle, slot_of(b, particle)}};
    };
    // The corner that all have, if there are more than two or two without a common edge.
    std::uint32_t shared = none;
    const Triangle& corners = topology.triangles[uses_[first].triangle];
    std::uint32_t in_all = 0;
    for (const std::uint32_t particle : corners) {
        bool everywhere = true;
        for (std::uint32_t use = first; use < last; ++use) everywhere = everywhere && slot_of(use, particle) < 3;
        if (!everywhere) continue;
        ++in_all;
        shared = particle;
    }
    if (in_all != 1) shared = none;
    std::vector<std::uint32_t> group(last - first);
    for (std::uint32_t i = 0; i < group.size(); ++i) group[i] = i;
    const auto unite = [&](std::uint32_t a, std::uint32_t b) {
        const std::uint32_t from = std::max(group[a], group[b]), to = std::min(group[a], group[b]);
        std::ranges::replace(group, from, to);
    };
    for (std::uint32_t a = first; a < last; ++a)
        for (std::uint32_t b = a + 1; b < last; ++b) {
            std::vector<std::uint32_t> common;
            for (const std::uint32_t particle : topology.triangles[uses_[a].triangle])
                if (slot_of(b, particle) < 3) common.push_back(particle);
            if (shared != none) common = {shared};
            if (common.empty()) continue;
            joints_.push_back({a, b, {pair_at(a, b, common.front()), pair_at(a, b, common.back())}});
            unite(a - first, b - first);
        }
    for (std::uint32_t i = 1; i < group.size(); ++i) {
        if (group[i] == 0) continue;
        const Joint::Corner same{uses_[first].triangle, 0};
        joints_.push_back({first, first + i, {std::array{same, same}, std::array{same, same}}});
        unite(0, i);
    }
}

// Per use: the lowest one with which it hangs together.
std::vector<std::uint32_t> PartingMesh::joined_uses(TriangleView triangles) const {
    std::vector<std::uint32_t> lowest(uses_.size());
    for (std::uint32_t i = 0; i < lowest.size(); ++i) lowest[i] = i;
    const auto root = [&](std::uint32_t use) {
        while (lowest[use] != use) use = lowest[use] = lowest[lowest[use]];
        return use;
    };
    for (const Joint& joint : joints_) {
        const bool holds = std::ranges::all_of(joint.pairs, [&](const auto& pair) {
            return triangles[pair[0].triangle][pair[0].slot] == triangles[pair[1].triangle][pair[1].slot];
        });
        if (!holds) continue;
        const std::uint32_t a = root(joint.a), b = root(joint.b);
        lowest[std::max(a, b)] = std::min(a, b);
    }
    for (std::uint32_t i = 0; i < lowest.size(); ++i) lowest[i] = root(i);
    return lowest;
}

PartingMesh::Parted PartingMesh::parted(TriangleView triangles) const {
    Parted now{mesh_, vertex_to_particle_, {}};
    std::vector<Triangle> keys;
    if (uses_.empty()) {
        keys.reserve(triangles.size());
        for (const Triangle& triangle : triangles) keys.push_back(is_removed(triangle) ? no_keys : triangle);
        part_vertices(now.mesh, keys, now.vertex_to_particle);
        return now;
    }
    const std::vector<std::uint32_t> lowest = joined_uses(triangles);
    keys.reserve(use_of_corner_.size());
    for (const auto& [a, b, c] : use_of_corner_)
        keys.push_back(is_removed(triangles[uses_[a].triangle]) ? no_keys : Triangle{lowest[a], lowest[b], lowest[c]});
    std::vector<std::uint32_t> use_of(mesh_.positions.size(), none);
    for (std::uint32_t use = 0; use < uses_.size(); ++use)
        if (use_of[uses_[use].vertex] == none) use_of[uses_[use].vertex] = use;
    part_vertices(now.mesh, keys, use_of);
    std::vector<BoundVertex> bound;
    bound.reserve(use_of.size());
    for (const std::uint32_t use : use_of) {
        bound.push_back(uses_[use].bound);
        bound.back().particles = triangles[uses_[use].triangle];
    }
    now.binding = {std::move(bound), farthest_};
    return now;
}

}  // namespace weft
