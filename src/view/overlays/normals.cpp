#include "view/overlay_parts.h"

#include <array>
#include <cmath>
#include <set>

namespace weft::overlay {
namespace {

constexpr Vec4 arrow_color{0.15f, 0.55f, 1.0f, 1};

// Number of arrows on a cloth that can still be distinguished.
constexpr double wanted = 1500;

// m: side of a square if `wanted` squares cover the cloth.
float spacing_of(const RenderMesh& mesh) {
    double area = 0;
    for (const auto& [a, b, c] : mesh.triangles)
        area += area_of(mesh.rest_positions[a], mesh.rest_positions[b], mesh.rest_positions[c]);
    return static_cast<float>(std::sqrt(area / wanted));
}

// The first vertex in every cube of that size. Uses the mesh at rest, so that every frame has the same vertices.
std::vector<std::uint32_t> thinned_out(const RenderMesh& mesh, float spacing) {
    std::set<std::array<std::int64_t, 3>> taken;
    std::vector<std::uint32_t> vertices;
    std::vector<std::uint8_t> used(mesh.rest_positions.size());
    for (const Triangle& triangle : mesh.triangles)
        for (const std::uint32_t v : triangle) used[v] = 1;
    for (std::uint32_t v = 0; v < mesh.rest_positions.size(); ++v) {
        if (!used[v]) continue;
        const Vec3 p = mesh.rest_positions[v] / spacing;
        // The offset avoids a cell boundary at 0, because rounding would split the vertices of a sheet that is centered
        // there.
        const auto cell = [](float x) { return static_cast<std::int64_t>(std::floor(x + 0.25f)); };
        if (taken.insert({cell(p.x), cell(p.y), cell(p.z)}).second) vertices.push_back(v);
    }
    return vertices;
}

}  // namespace

void normals(const OverlayInput& input, OverlayOutput& output) {
    for (const ClothFrame& cloth : input.frame.cloths) {
        const RenderMesh& mesh = cloth.render_mesh();
        const float spacing = spacing_of(mesh);
        if (!(spacing > 0)) continue;
        const float reach = std::min(std::max(spacing, cloth.model->mean_edge) * 0.9f, 0.1f * input.size);
        for (const std::uint32_t v : thinned_out(mesh, spacing)) {
            const Vec3 from = mesh.positions[v];
            add_line(output.lines, from, from + mesh.normals[v] * reach, arrow_color, pixels(input, 1.3f));
        }
    }
}

}  // namespace weft::overlay
