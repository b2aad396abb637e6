#include "weft/drawn_solids.h"

#include "mesh/sound_triangles.h"
#include "mesh/weld.h"
#include "scene/materials.h"
#include "solver/world/collider_mesh.h"

#include <algorithm>
#include <string>
#include <utility>

namespace weft {
namespace {

bool has_shape_of(const Collider& a, const Collider& b) {
    return a.shape == b.shape && a.numbers == b.numbers && a.data == b.data;
}

/// Joins vertices of the same place and normal, and drops triangles without area. Programs such as Blender compute
/// normals from the triangles, and would show a seam where a round shape begins and ends.
TriangleMesh joined(const TriangleMesh& mesh) {
    constexpr float same_place = 1e-6f;     // of the diagonal
    constexpr float same_normal = 0.9999f;  // cosine: 0.8°
    const Weld weld = weld_vertices(mesh.positions, same_place * length(bounds_of(mesh.positions).size()));
    std::vector<std::vector<std::uint32_t>> at_place(weld.first_vertex.size());  // vertices of `whole`
    std::vector<std::uint32_t> number(mesh.positions.size());
    TriangleMesh whole;
    for (std::size_t v = 0; v < number.size(); ++v) {
        std::vector<std::uint32_t>& near = at_place[weld.vertex_to_welded[v]];
        const auto same = std::ranges::find_if(
            near, [&](std::uint32_t other) { return dot(whole.normals[other], mesh.normals[v]) > same_normal; });
        if (same != near.end()) {
            number[v] = *same;
            continue;
        }
        number[v] = static_cast<std::uint32_t>(whole.positions.size());
        near.push_back(number[v]);
        whole.positions.push_back(mesh.positions[weld.first_vertex[weld.vertex_to_welded[v]]]);
        whole.normals.push_back(mesh.normals[v]);
    }
    for (const auto& [a, b, c] : mesh.triangles) whole.triangles.push_back({number[a], number[b], number[c]});
    whole.triangles = sound_triangles(whole.triangles, whole.positions).triangles;
    return whole;
}

/// Of a mesh from a file, its own vertices and triangles.
TriangleMesh solid_mesh(const Collider& collider) {
    TriangleMesh mesh = mesh_of(collider);
    return collider.shape == ShapeKind::mesh || mesh.triangles.empty() ? mesh : joined(mesh);
}

// World and scene list the colliders in the same order, so the collider with this name is usually at this `place`.
const Material& solid_material(std::span<const SceneCollider> colliders, const std::string& name, std::size_t place) {
    if (place < colliders.size() && colliders[place].name == name) return material_of(colliders[place]);
    const auto found = std::ranges::find(colliders, name, &SceneCollider::name);
    return found != colliders.end() ? material_of(*found)
                                    : default_material(ColliderDesc{.shape = SphereDesc{}}).material;
}

}  // namespace

void DrawnSolids::choose(const World& world) {
    const std::vector<Collider>& colliders = world.colliders();
    for (std::size_t i = 0; i < colliders.size(); ++i) {
        const Collider& collider = colliders[i];
        if (choice_ == SolidChoice::bodies && !collider.body) continue;
        const auto same = std::ranges::find_if(
            chosen_, [&](const Chosen& other) { return has_shape_of(world.collider(other.id), collider); });
        auto mesh = same != chosen_.end() ? same->mesh : std::make_shared<const TriangleMesh>(solid_mesh(collider));
        if (mesh->triangles.empty()) continue;
        chosen_.push_back({world.collider_id(i), std::move(mesh)});
    }
}

void DrawnSolids::update(const World& world, std::span<const SceneCollider> colliders) {
    (void)world.summary();  // waits for the poses of bodies
    if (!std::exchange(has_chosen_, true)) choose(world);
    solids_.clear();
    for (const Chosen& chosen : chosen_) {
        if (!world.contains(chosen.id)) continue;
        const Collider& collider = world.collider(chosen.id);
        const auto place = static_cast<std::size_t>(&collider - world.colliders().data());
        solids_.push_back({.name = collider.name,
                           .mesh = chosen.mesh.get(),
                           .pose = collider.pose,
                           .material = &solid_material(colliders, collider.name, place)});
    }
}

}  // namespace weft
