#include "editor/tools/vertex_selection.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace weft::editor {
namespace {

// Per vertex: whether a triangle has it.
std::vector<std::uint8_t> used_vertices(const MeshView& mesh) {
    std::vector<std::uint8_t> used(mesh.vertices());
    for (std::uint32_t t = 0; t < mesh.triangles(); ++t)
        for (const std::uint32_t corner : mesh.triangle(t))
            if (corner < mesh.vertices()) used[corner] = 1;
    return used;
}

bool shown(const Projection& view, Vec3 point, const HiddenBy* hidden_by) {
    return !hidden_by || is_visible(view, point, hidden_by->scene, hidden_by->tolerance);
}

template <class Contains>
std::vector<std::uint32_t> vertices_inside(const Projection& view, const MeshView& mesh, const HiddenBy* hidden_by,
                                           Contains&& contains) {
    std::vector<std::uint32_t> inside;
    const std::vector<std::uint8_t> used = used_vertices(mesh);
    for (std::uint32_t v = 0; v < mesh.vertices(); ++v) {
        if (!used[v]) continue;
        const auto seen = view.project(mesh.position(v));
        if (seen && contains(seen->pixel) && shown(view, mesh.position(v), hidden_by)) inside.push_back(v);
    }
    return inside;
}

constexpr std::size_t most_bands = 4096;

}  // namespace

Lasso::Lasso(std::span<const Vec2> polygon) {
    constexpr double unbounded = std::numeric_limits<double>::infinity();
    std::vector<Double2> corners;
    min_ = {unbounded, unbounded}, max_ = {-unbounded, -unbounded};
    for (const Vec2 corner : polygon) {
        if (!finite(corner)) continue;
        const Double2 p = exact(corner);
        corners.push_back(p);
        min_ = {std::min(min_.x, p.x), std::min(min_.y, p.y)};
        max_ = {std::max(max_.x, p.x), std::max(max_.y, p.y)};
    }
    if (corners.size() < 3) return;
    const double height = max_.y - min_.y;
    bands_.resize(std::clamp(static_cast<std::size_t>(std::min(height, 1e6)), std::size_t{1}, most_bands));
    band_height_ = std::max(height / static_cast<double>(bands_.size()), 1e-9);
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Side side{corners[i], corners[(i + 1) % corners.size()]};
        const auto [low, high] = std::minmax(side.from.y, side.to.y);
        for (std::size_t band = band_of(low); band <= band_of(high); ++band) bands_[band].push_back(side);
    }
}

std::size_t Lasso::band_of(double y) const {
    const double band = std::clamp((y - min_.y) / band_height_, 0.0, static_cast<double>(bands_.size() - 1));
    return static_cast<std::size_t>(band);
}

// Counts the sides that a line to the right crosses, upward and downward ones with different signs.
bool Lasso::contains(Vec2 pixel) const {
    const Double2 p = exact(pixel);
    if (bands_.empty() || !(p.x >= min_.x && p.x <= max_.x && p.y >= min_.y && p.y <= max_.y)) return false;
    int turns = 0;
    for (const auto& [from, to] : bands_[band_of(p.y)]) {
        const double side = (to.x - from.x) * (p.y - from.y) - (p.x - from.x) * (to.y - from.y);
        if (from.y <= p.y && to.y > p.y && side > 0) ++turns;
        if (from.y > p.y && to.y <= p.y && side < 0) --turns;
    }
    return turns != 0;
}

std::optional<std::uint32_t> vertex_at(const Projection& view, const MeshView& mesh, Vec2 pixel, float radius,
                                       const HiddenBy* hidden_by) {
    if (!finite(pixel)) return std::nullopt;
    struct Candidate {
        double off;
        float depth;
        std::uint32_t vertex;
    };
    std::vector<Candidate> candidates;
    const std::vector<std::uint8_t> used = used_vertices(mesh);
    for (std::uint32_t v = 0; v < mesh.vertices(); ++v) {
        const auto seen = used[v] ? view.project(mesh.position(v)) : std::nullopt;
        if (!seen) continue;
        const double off = length(exact(seen->pixel) - exact(pixel));
        if (off <= static_cast<double>(radius)) candidates.push_back({off, seen->depth, v});
    }
    std::ranges::sort(candidates, [](const Candidate& a, const Candidate& b) {
        return a.off != b.off ? a.off < b.off : a.depth != b.depth ? a.depth < b.depth : a.vertex < b.vertex;
    });
    for (const Candidate& candidate : candidates)
        if (shown(view, mesh.position(candidate.vertex), hidden_by)) return candidate.vertex;
    return std::nullopt;
}

std::vector<std::uint32_t> vertices_in_box(const Projection& view, const MeshView& mesh, Vec2 a, Vec2 b,
                                           const HiddenBy* hidden_by) {
    if (!finite(a) || !finite(b)) return {};
    const Vec2 min{std::min(a.x, b.x), std::min(a.y, b.y)}, max{std::max(a.x, b.x), std::max(a.y, b.y)};
    return vertices_inside(view, mesh, hidden_by,
                           [&](Vec2 p) { return p.x >= min.x && p.x <= max.x && p.y >= min.y && p.y <= max.y; });
}

std::vector<std::uint32_t> vertices_in_lasso(const Projection& view, const MeshView& mesh,
                                             std::span<const Vec2> polygon, const HiddenBy* hidden_by) {
    const Lasso lasso(polygon);
    return vertices_inside(view, mesh, hidden_by, [&](Vec2 p) { return lasso.contains(p); });
}

}  // namespace weft::editor
