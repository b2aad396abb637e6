#include "view/field_surfaces.h"

#include "collide/field_surface.h"
#include "mesh/weld.h"
#include "solver/measures/true_surfaces.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace weft {
namespace {

bool has_field(const Collider& collider) {
    return collider.shape == ShapeKind::mesh && collider.data && cell_of_field(*collider.data) > 0;
}

void compare_with_mesh(const Collider& collider, FieldSurface& surface) {
    TrueSurfaces truth;
    for (const Vec3 p : surface.mesh.positions) {
        const auto error = static_cast<float>(truth.distance(collider, p) / double{surface.cell});
        surface.errors.push_back(error);
        surface.least = std::min(surface.least, error);
        surface.most = std::max(surface.most, error);
    }
}

/// The edges of a mesh, once each; those along a seam too.
std::vector<std::array<Vec3, 2>> edges_of(const TriangleMesh& mesh) {
    const Weld weld = weld_vertices(mesh.positions, 0);
    std::vector<std::pair<std::uint32_t, std::uint32_t>> numbers;
    for (const Triangle& triangle : mesh.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            const auto [low, high] =
                std::minmax(weld.vertex_to_welded[triangle[k]], weld.vertex_to_welded[triangle[(k + 1) % 3]]);
            if (low != high) numbers.emplace_back(low, high);
        }
    }
    std::ranges::sort(numbers);
    numbers.erase(std::ranges::unique(numbers).begin(), numbers.end());
    std::vector<std::array<Vec3, 2>> edges;
    for (const auto& [low, high] : numbers)
        edges.push_back({mesh.positions[weld.first_vertex[low]], mesh.positions[weld.first_vertex[high]]});
    return edges;
}

/// Examines the edges of the mesh in pieces of half a cell.
void find_beyond(const Collider& collider, FieldSurface& surface) {
    for (const auto& [from, to] : edges_of(surface.shape->surface)) {
        const float pieces = std::max(1.0f, std::ceil(2 * length(to - from) / surface.cell));
        for (float i = 0; i < pieces; ++i) {
            const Vec3 a = from + (to - from) * (i / pieces), b = from + (to - from) * ((i + 1) / pieces);
            const auto distance = static_cast<float>(signed_distance(collider, (a + b) * 0.5f)) / surface.cell;
            surface.farthest_beyond = std::max(surface.farthest_beyond, distance);
            if (distance > FieldSurface::beyond_counts) surface.beyond.push_back({a, b});
        }
    }
}

}  // namespace

std::shared_ptr<const FieldSurface> FieldSurfaces::of(const Collider& collider) {
    if (!has_field(collider)) return nullptr;
    auto& known = known_[collider.data.get()];
    if (!known) {
        Collider in_own_frame = collider;
        in_own_frame.pose = {};
        auto made = std::make_shared<FieldSurface>();
        made->shape = collider.data;
        made->cell = cell_of_field(*collider.data);
        made->mesh = zero_surface_of_field(*collider.data);
        compare_with_mesh(in_own_frame, *made);
        find_beyond(in_own_frame, *made);
        known = std::move(made);
    }
    return known;
}

void FieldSurfaces::keep(std::span<const Collider> colliders) {
    std::erase_if(known_, [&](const auto& entry) {
        return std::ranges::none_of(colliders, [&](const Collider& c) { return c.data.get() == entry.first; });
    });
}

}  // namespace weft
