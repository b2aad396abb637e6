#include "solver/measures/pieces.h"
#include "view/overlay_parts.h"

#include <string>

namespace weft::overlay {

// Both sides of each open edge.
void rims(const OverlayInput& input, OverlayOutput& output) {
    constexpr Vec4 color{1.0f, 0.35f, 0.05f, 1};
    const float width = pixels(input, 2);
    std::size_t count = 0;
    for (const ClothFrame& cloth : input.frame.cloths) {
        const std::vector<OpenEdge> open = open_edges(*cloth.model);
        count += open.size();
        if (open.empty()) continue;
        const float lifted = lift(input, *cloth.model);
        for (const OpenEdge& sides : open) {
            for (const auto& [a, b] : sides) {
                add_line_on_surface(output.lines, cloth.positions[a].xyz(), cloth.positions[b].xyz(),
                                    cloth.normals[a].xyz(), cloth.normals[b].xyz(), lifted, color, width);
            }
        }
    }
    output.legends.push_back({.title = "rims", .entries = {{color, "open edges: " + std::to_string(count)}}});
}

}  // namespace weft::overlay
