#include "mesh/weld.h"
#include "view/overlay_parts.h"

#include <algorithm>
#include <array>

namespace weft::overlay {
namespace {

constexpr Vec4 color{0.05f, 0.06f, 0.08f, 0.6f};

// Edges that are shorter than so many pixels are fainter: what they lie on must be seen.
constexpr float full_pixels = 9;

Vec4 color_on(const ClothModel& model, float pixel) {
    Vec4 faded = color;
    faded.w *= std::clamp(model.mean_edge / (pixel * full_pixels), 0.2f, 1.0f);
    return faded;
}

using Ends = std::array<std::uint32_t, 2>;

// The edges of a drawn mesh, as vertices, each once: of those that several triangles have, and of those along seams.
std::vector<Ends> unique_edges(const TriangleMesh& mesh) {
    const Weld weld = weld_vertices(mesh.positions, 0);
    std::vector<Ends> edges;
    edges.reserve(mesh.triangles.size() * 3);
    for (const Triangle& triangle : mesh.triangles) {
        for (int side = 0; side < 3; ++side) {
            const std::uint32_t a = weld.vertex_to_welded[triangle[side]];
            const std::uint32_t b = weld.vertex_to_welded[triangle[(side + 1) % 3]];
            if (a != b) edges.push_back({std::min(a, b), std::max(a, b)});
        }
    }
    std::ranges::sort(edges);
    edges.erase(std::ranges::unique(edges).begin(), edges.end());
    for (Ends& edge : edges) edge = {weld.first_vertex[edge[0]], weld.first_vertex[edge[1]]};
    return edges;
}

// A mesh that is simulated itself has them already.
std::vector<Ends> drawn_edges(const ClothModel& model) {
    if (!model.binding.empty()) return unique_edges(model.mesh());
    const std::vector<std::uint32_t> vertex = first_vertices(model);
    std::vector<Ends> edges;
    for_each_edge(model, [&](const EdgeEnds& ends, bool) {
        const auto [a, b] = ends;
        if (vertex[a] != none && vertex[b] != none) edges.push_back({vertex[a], vertex[b]});
    });
    return edges;
}

}  // namespace

void wireframe(const OverlayInput& input, OverlayOutput& output) {
    const float width = pixels(input, 1.2f);
    for (std::size_t i = 0; i < input.frame.cloths.size(); ++i) {
        const ClothModel& model = *input.frame.cloths[i].model;
        const auto& positions = input.positions[i];
        const auto& normals = input.normals[i];
        const float lifted = lift(input, model);
        const Vec4 faded = color_on(model, pixel_size(input));
        for (const auto& [a, b] : drawn_edges(model))
            add_line_on_surface(output.lines, positions[a], positions[b], normals[a], normals[b], lifted, faded, width);
    }
}

}  // namespace weft::overlay
