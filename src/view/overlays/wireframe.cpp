#include "mesh/weld.h"
#include "view/overlay_parts.h"

#include <algorithm>
#include <array>

namespace weft::overlay {
namespace {

constexpr Vec4 line_color{0.05f, 0.06f, 0.08f, 0.6f};

// Edges shorter than so many pixels are fainter, so that the surface stays visible.
constexpr float full_pixels = 9;

Vec4 color_on(const ClothModel& model, float pixel) {
    Vec4 faded = line_color;
    faded.w *= std::clamp(model.mean_edge / (pixel * full_pixels), 0.2f, 1.0f);
    return faded;
}

using Ends = std::array<std::uint32_t, 2>;

// Each edge once, with ascending ends. `welded` maps a corner to its welded point.
template <class Triangles, class Welded>
std::vector<Ends> unique_edges(const Triangles& triangles, Welded&& welded) {
    std::vector<Ends> edges;
    edges.reserve(std::size_t{3} * triangles.size());
    for (const Triangle& triangle : triangles) {
        for (int side = 0; side < 3; ++side) {
            const std::uint32_t a = welded(triangle[side]), b = welded(triangle[(side + 1) % 3]);
            if (a != b) edges.push_back({std::min(a, b), std::max(a, b)});
        }
    }
    std::ranges::sort(edges);
    edges.erase(std::ranges::unique(edges).begin(), edges.end());
    return edges;
}

// The edges of the render mesh, as pairs of vertices. An edge along a seam appears once, until the cloth parts: then
// both sides of a cut would be at the same place at rest.
std::vector<Ends> drawn_edges(const ClothFrame& cloth) {
    if (!cloth.model->binding.empty()) {
        const RenderMesh& mesh = cloth.render_mesh();
        if (!cloth.model->copied_from.empty()) return unique_edges(mesh.triangles, [](auto v) { return v; });
        const Weld weld = weld_vertices(mesh.rest_positions, 0);
        std::vector<Ends> edges = unique_edges(mesh.triangles, [&](auto v) { return weld.vertex_to_welded[v]; });
        for (Ends& edge : edges) edge = {weld.first_vertex[edge[0]], weld.first_vertex[edge[1]]};
        return edges;
    }
    // The simulated mesh is the render mesh, and welded already.
    const std::vector<std::uint32_t> vertex = first_vertices(*cloth.model);
    std::vector<Ends> edges = unique_edges(cloth.triangles, [](std::uint32_t particle) { return particle; });
    std::erase_if(edges, [&](const Ends& edge) { return vertex[edge[0]] == none || vertex[edge[1]] == none; });
    for (Ends& edge : edges) edge = {vertex[edge[0]], vertex[edge[1]]};
    return edges;
}

}  // namespace

void wireframe(const OverlayInput& input, OverlayOutput& output) {
    const float width = pixels(input, 1.2f);
    for (const ClothFrame& cloth : input.frame.cloths) {
        const auto& positions = cloth.render_mesh().positions;
        const auto& normals = cloth.render_mesh().normals;
        const float lifted = lift(input, *cloth.model);
        const Vec4 faded = color_on(*cloth.model, pixel_size(input));
        for (const auto& [a, b] : drawn_edges(cloth))
            add_line_on_surface(output.lines, positions[a], positions[b], normals[a], normals[b], lifted, faded, width);
    }
}

}  // namespace weft::overlay
