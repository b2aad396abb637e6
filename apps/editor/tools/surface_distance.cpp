#include "editor/tools/surface_distance.h"

#include "physics/tether/through_triangle.h"

#include <algorithm>
#include <limits>

namespace weft::editor {
namespace {

constexpr double not_reached = std::numeric_limits<double>::infinity();

double exact_distance(Vec3 a, Vec3 b) {
    return std::sqrt(dot_exact(b - a, b - a));
}

}  // namespace

Vec3 point_of(const MeshView& mesh, const MeshPlace& place) {
    const auto [a, b, c] = mesh.triangle(place.triangle);
    return mesh.position(a) * place.weights.x + mesh.position(b) * place.weights.y + mesh.position(c) * place.weights.z;
}

SurfaceDistance::SurfaceDistance(const MeshView& mesh)
    : triangles_(mesh.triangles()),
      queue_(mesh.vertices()),
      distance_(mesh.vertices(), not_reached),
      final_(mesh.vertices()) {
    const auto in_range = [&](const Triangle& t) {
        return std::ranges::all_of(t, [&](std::uint32_t v) { return v < mesh.vertices(); });
    };
    sectors_ = group_items<std::uint32_t>(mesh.vertices(), [&](auto put) {
        for (std::uint32_t t = 0; t < mesh.triangles(); ++t)
            if (const Triangle corners = mesh.triangle(t); in_range(corners))
                for (const std::uint32_t corner : corners) put(corner, t);
    });
    // Each edge once from either end, although two triangles may have it.
    neighbors_.offsets.assign(std::size_t{mesh.vertices()} + 1, 0);
    std::vector<std::uint32_t> around;
    for (std::uint32_t v = 0; v < mesh.vertices(); ++v) {
        around.clear();
        for (std::uint32_t i = sectors_.offsets[v]; i < sectors_.offsets[v + 1]; ++i)
            for (const std::uint32_t corner : mesh.triangle(sectors_.items[i]))
                if (corner != v) around.push_back(corner);
        std::ranges::sort(around);
        around.erase(std::unique(around.begin(), around.end()), around.end());
        neighbors_.items.insert(neighbors_.items.end(), around.begin(), around.end());
        neighbors_.offsets[v + 1] = static_cast<std::uint32_t>(neighbors_.items.size());
    }
}

void SurfaceDistance::offer(std::uint32_t vertex, double distance) {
    if (final_[vertex] || !(distance <= radius_) || !(distance < distance_[vertex])) return;
    distance_[vertex] = distance;
    queue_.put(vertex, distance);
}

std::span<const ReachedVertex> SurfaceDistance::from(const MeshView& mesh, const MeshPlace& place, float radius) {
    reached_.clear();
    radius_ = static_cast<double>(radius);
    if (mesh.vertices() != vertices() || mesh.triangles() != triangles_ || place.triangle >= triangles_) return {};
    const Triangle first = mesh.triangle(place.triangle);
    if (!mesh.sound(first) || !finite(place.weights)) return {};
    const Vec3 source = point_of(mesh, place);
    for (const std::uint32_t corner : first) offer(corner, exact_distance(source, mesh.position(corner)));
    while (!queue_.empty()) {
        const std::uint32_t v = queue_.pop().item;
        final_[v] = 1;
        reached_.push_back({v, static_cast<float>(distance_[v])});
        const Vec3 at = mesh.position(v);
        for (std::uint32_t i = sectors_.offsets[v]; i < sectors_.offsets[v + 1]; ++i) {
            const Triangle t = mesh.triangle(sectors_.items[i]);
            if (!mesh.sound(t)) continue;
            const std::size_t k = t[0] == v ? 0 : t[1] == v ? 1 : 2;
            const std::uint32_t p = t[(k + 1) % 3], q = t[(k + 2) % 3];
            const Vec3 at_p = mesh.position(p), at_q = mesh.position(q);
            offer(p, distance_[v] + exact_distance(at, at_p));
            offer(q, distance_[v] + exact_distance(at, at_q));
            if (final_[p]) offer(q, through_triangle(at, at_p, at_q, distance_[v], distance_[p]));
            if (final_[q]) offer(p, through_triangle(at, at_q, at_p, distance_[v], distance_[q]));
        }
    }
    for (const ReachedVertex& r : reached_) distance_[r.vertex] = not_reached, final_[r.vertex] = 0;
    // Where triangles are obtuse, a vertex may be reached after one that is farther away.
    std::ranges::sort(reached_, [](const ReachedVertex& a, const ReachedVertex& b) {
        return a.distance != b.distance ? a.distance < b.distance : a.vertex < b.vertex;
    });
    return reached_;
}

}  // namespace weft::editor
