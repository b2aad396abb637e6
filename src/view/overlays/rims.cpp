#include "solver/measures/pieces.h"
#include "view/overlay_parts.h"

#include <string>

namespace weft::overlay {

// Both sides of each open edge. Cloth that can be cut is drawn as it is simulated, vertex by vertex.
void rims(const OverlayInput& input, OverlayOutput& output) {
    constexpr Vec4 color{1.0f, 0.35f, 0.05f, 1};
    const float width = pixels(input, 2);
    std::size_t count = 0;
    for (const ClothFrame& cloth : input.frame.cloths) {
        const std::vector<OpenEdge> open = open_edges(*cloth.model);
        count += open.size();
        if (open.empty()) continue;
        const std::vector<std::uint32_t> vertex = first_vertices(*cloth.model);
        const auto& positions = cloth.render_mesh().positions;
        const auto& normals = cloth.render_mesh().normals;
        const float lifted = lift(input, *cloth.model);
        for (const OpenEdge& sides : open) {
            for (const auto& [a, b] : sides) {
                const std::uint32_t from = vertex[a], to = vertex[b];
                add_line_on_surface(output.lines, positions[from], positions[to], normals[from], normals[to], lifted,
                                    color, width);
            }
        }
    }
    output.legends.push_back({.title = "rims", .entries = {{color, "open edges: " + std::to_string(count)}}});
}

}  // namespace weft::overlay
