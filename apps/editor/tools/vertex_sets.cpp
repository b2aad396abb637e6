#include "editor/tools/vertex_sets.h"

#include <algorithm>
#include <array>
#include <iterator>

namespace weft::editor {
namespace {

/// Per vertex of the mesh: whether it is in the set.
std::vector<std::uint8_t> marks_of(const MeshView& mesh, const VertexSet& set) {
    std::vector<std::uint8_t> marks(mesh.vertices());
    for (const std::uint32_t vertex : set)
        if (vertex < marks.size()) marks[vertex] = 1;
    return marks;
}

VertexSet marked(const std::vector<std::uint8_t>& marks) {
    VertexSet set;
    for (std::uint32_t v = 0; v < marks.size(); ++v)
        if (marks[v]) set.push_back(v);
    return set;
}

/// Calls `take` for each triangle of three different vertices of the mesh.
template <class Take>
void for_triangles(const MeshView& mesh, Take&& take) {
    for (std::uint32_t t = 0; t < mesh.triangles(); ++t) {
        const auto [a, b, c] = mesh.triangle(t);
        if (a < mesh.vertices() && b < mesh.vertices() && c < mesh.vertices() && a != b && b != c && c != a)
            take(std::array{a, b, c});
    }
}

}  // namespace

VertexSet make_set(std::vector<std::uint32_t> vertices) {
    std::ranges::sort(vertices);
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    return vertices;
}

VertexSet with(const VertexSet& set, const VertexSet& more) {
    VertexSet both;
    std::ranges::set_union(set, more, std::back_inserter(both));
    return both;
}

VertexSet without(const VertexSet& set, const VertexSet& fewer) {
    VertexSet left;
    std::ranges::set_difference(set, fewer, std::back_inserter(left));
    return left;
}

bool holds(const VertexSet& set, std::uint32_t vertex) {
    return std::ranges::binary_search(set, vertex);
}

VertexSet all_vertices(const MeshView& mesh) {
    std::vector<std::uint8_t> used(mesh.vertices());
    for_triangles(mesh, [&](const auto& corners) {
        for (const std::uint32_t v : corners) used[v] = 1;
    });
    return marked(used);
}

VertexSet grown(const MeshView& mesh, const VertexSet& set) {
    const std::vector<std::uint8_t> in = marks_of(mesh, set);
    std::vector<std::uint8_t> more = in;
    for_triangles(mesh, [&](const auto& corners) {
        if (!in[corners[0]] && !in[corners[1]] && !in[corners[2]]) return;
        for (const std::uint32_t v : corners) more[v] = 1;
    });
    return marked(more);
}

VertexSet shrunk(const MeshView& mesh, const VertexSet& set) {
    const std::vector<std::uint8_t> in = marks_of(mesh, set);
    std::vector<std::uint8_t> left = in;
    for_triangles(mesh, [&](const auto& corners) {
        if (in[corners[0]] && in[corners[1]] && in[corners[2]]) return;
        for (const std::uint32_t v : corners) left[v] = 0;
    });
    return marked(left);
}

VertexSet boundary_of(const MeshView& mesh, const VertexSet& set) {
    const std::vector<std::uint8_t> in = marks_of(mesh, set);
    std::vector<std::uint8_t> border(mesh.vertices());
    std::vector<std::array<std::uint32_t, 2>> edges;
    for_triangles(mesh, [&](const auto& corners) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t a = corners[k], b = corners[(k + 1) % 3];
            if (in[a] != in[b]) border[in[a] ? a : b] = 1;
            if (in[a] && in[b]) edges.push_back({std::min(a, b), std::max(a, b)});
        }
    });
    std::ranges::sort(edges);
    for (std::size_t i = 0; i < edges.size();) {
        std::size_t end = i + 1;
        while (end < edges.size() && edges[end] == edges[i]) ++end;
        if (end == i + 1) border[edges[i][0]] = border[edges[i][1]] = 1;
        i = end;
    }
    return marked(border);
}

}  // namespace weft::editor
