// Checks how the drawn mesh of a cloth parts.
#pragma once

#include "solver/state/frame.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <tuple>
#include <vector>

namespace weft::test {

/// The piece of cloth that each particle belongs to.
inline std::vector<std::uint32_t> piece_of_particles(const ClothModel& model) {
    std::vector<std::uint32_t> piece(model.particle_count);
    std::iota(piece.begin(), piece.end(), 0u);
    const auto root = [&](std::uint32_t p) {
        while (piece[p] != p) p = piece[p] = piece[piece[p]];
        return p;
    };
    for (const Triangle& triangle : model.triangles())
        for (const std::uint32_t p : triangle) piece[root(p)] = root(triangle[0]);
    for (std::uint32_t p = 0; p < piece.size(); ++p) piece[p] = root(p);
    return piece;
}

/// The pieces that the drawn triangles show. Expects that each shows one alone.
inline std::set<std::uint32_t> expect_no_triangle_spans_pieces(const ClothModel& model) {
    const std::vector<std::uint32_t> piece = piece_of_particles(model);
    const auto shown = [&](std::uint32_t vertex) {
        if (model.binding.empty()) return piece[model.vertex_to_particle[vertex]];
        const auto& [a, b, c] = model.binding.vertices[vertex].particles;
        EXPECT_TRUE(piece[a] == piece[b] && piece[b] == piece[c]) << "vertex " << vertex;
        return piece[a];
    };
    std::set<std::uint32_t> all;
    for (std::size_t t = 0; t < model.mesh().triangles.size(); ++t) {
        const auto& [a, b, c] = model.mesh().triangles[t];
        EXPECT_TRUE(shown(a) == shown(b) && shown(b) == shown(c)) << "triangle " << t;
        all.insert(shown(a));
    }
    return all;
}

inline double area_of(std::span<const Triangle> triangles, std::span<const Vec3> positions) {
    double area = 0;
    for (const auto& [a, b, c] : triangles)
        area += 0.5 * static_cast<double>(length(cross(positions[b] - positions[a], positions[c] - positions[a])));
    return area;
}
inline double drawn_area(const ClothFrame& cloth) {
    const RenderMesh& mesh = cloth.render_mesh();
    return area_of(mesh.triangles, mesh.positions);
}

/// m: the largest distance between vertices that had the same place when the cloth was built. Vertices of no triangle
/// do not count.
inline float widest_gap(const ClothFrame& cloth) {
    const RenderMesh& mesh = cloth.render_mesh();
    std::map<std::tuple<float, float, float>, std::set<std::uint32_t>> there;
    for (const Triangle& triangle : mesh.triangles)
        for (const std::uint32_t v : triangle) {
            const Vec3 rest = mesh.rest_positions[v];
            there[{rest.x, rest.y, rest.z}].insert(v);
        }
    float widest = 0;
    for (const auto& [rest, vertices] : there)
        for (const std::uint32_t v : vertices)
            widest = std::max(widest, length(mesh.positions[v] - mesh.positions[*vertices.begin()]));
    return widest;
}

}  // namespace weft::test
