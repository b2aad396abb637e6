#include "weft/cloth_building.h"

#include "mesh/procedural.h"
#include "mesh/topology.h"
#include "scene/problems.h"
#include "solver/model/tear_law.h"
#include "weft/painting.h"

#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>
#include <variant>

namespace weft {
namespace {

struct LoadedMesh {
    TriangleMesh mesh;
    std::string from;  // name in error messages
};

Result<LoadedMesh> load(const GridDesc& grid, const MeshFiles&) {
    return LoadedMesh{make_grid(grid.size, grid.resolution, grid.diagonal), "grid"};
}
Result<LoadedMesh> load(const SphereMeshDesc& sphere, const MeshFiles&) {
    return LoadedMesh{make_sphere(sphere.radius, sphere.subdivisions), "sphere"};
}
Result<LoadedMesh> load(const BoxMeshDesc& box, const MeshFiles&) {
    return LoadedMesh{make_box(box.size, box.resolution), "box"};
}
Result<LoadedMesh> load(const TriangleMesh& mesh, const MeshFiles&) {
    return LoadedMesh{mesh, "mesh"};
}
Result<LoadedMesh> load(const MeshFileDesc& desc, const MeshFiles& files) {
    if (!files.read)
        return Error{desc.file, "cannot be read: this program reads no mesh files (Options::read_mesh is empty)"};
    auto mesh = files.read(desc.file, files.folder);
    if (!mesh) return mesh.errors();
    return LoadedMesh{std::move(*mesh), desc.file};
}

// Loads a mesh and places it in the world.
Result<LoadedMesh> load_placed(const MeshDesc& desc, const TransformDesc& transform, const MeshFiles& files) {
    auto loaded = std::visit([&](const auto& shape) { return load(shape, files); }, desc);
    if (loaded) place_mesh(loaded->mesh, desc, transform);
    return loaded;
}

void note_report(const std::string& cloth, const TopologyReport& report, std::vector<std::string>& notes) {
    const auto note = [&](std::uint32_t count, std::string_view what) {
        if (count > 0) notes.push_back("cloth '" + cloth + "': " + std::to_string(count) + ' ' + std::string(what));
    };
    note(report.isolated_vertices, "vertices that no triangle uses stay where they are");
    note(report.degenerate_triangles, "triangles without an area left out");
    note(report.duplicate_triangles, "doubled triangles left out");
    note(report.non_manifold_edges, "edges with three or more triangles do not bend");
    note(report.inconsistent_edges, "edges between triangles of opposite winding");
}

// Warns if the two meshes do not coincide, which usually means a wrong scale or axis.
void note_binding(const ClothModel& model, std::vector<std::string>& notes) {
    constexpr float far_apart = 0.1f;  // of the extent; linings, trimmings and decimated meshes are nearer
    Bounds bounds;
    for (std::uint32_t p = 0; p < model.particle_count; ++p) bounds.include(model.rest_position(p));
    const float extent = length(bounds.size());
    if (model.binding.farthest > far_apart * extent)
        notes.push_back("cloth '" + model.name + "': the render mesh lies up to " +
                        number_text(model.binding.farthest) + " m away from the simulated one");
}

ClothCollision collision_of(const SceneCloth& cloth) {
    return {cloth.self_collision, {1u << cloth.collision_group, cloth.collision_mask}, cloth.layer};
}

}  // namespace

ClothReserve reserve_of(const SceneCloth& cloth, std::uint32_t particles) {
    if (cloth.tearing == Tearing::off) return {};
    const bool erodes = cloth.tearing == Tearing::erode;
    constexpr std::uint32_t least = 256;
    return {.particles = least + static_cast<std::uint32_t>(cloth.tear_room * static_cast<float>(particles)),
            .openings = true,
            .tears = erodes || cloth.tearing == Tearing::split,
            .erodes = erodes};
}

Fabric fabric_of(const SceneCloth& cloth) {
    Fabric fabric = cloth.fabric;
    fabric.tether = {cloth.tethers, cloth.tether_slack};
    return fabric;
}

const TriangleMesh& simulated_mesh(const ClothModel& model, const ClothSource& source) {
    return source.simulated ? *source.simulated : model.mesh();
}

namespace {

/// The particles that the cloth was built with, without copies.
PinnedCloth at_rest(const ClothModel& model, const ClothSource& source) {
    return {.mesh = simulated_mesh(model, source),
            .numbers = *source.numbers,
            .positions = {model.start.data(), source.numbers->particle_count}};
}

}  // namespace

Result<std::shared_ptr<const ClothModel>> with_resistance(const ClothModel& model, const ClothSource& source,
                                                          const SceneCloth& cloth, const std::string& pointer) {
    auto paint = repaint_resistance(cloth, model, at_rest(model, source), pointer);
    if (!paint) return paint.errors();
    return with_tear_paint(model, std::move(*paint));
}

Result<BuiltCloth> build_cloth(const SceneCloth& cloth, const MeshFiles& files, const World& world,
                               const std::string& pointer, std::vector<std::string>& notes) {
    auto loaded = load_placed(cloth.mesh, cloth.transform, files);
    if (!loaded) return within(pointer + "/mesh/file", loaded.errors());
    std::optional<TriangleMesh> drawn;
    if (cloth.render_mesh) {
        auto other = load_placed(*cloth.render_mesh, cloth.transform, files);
        if (!other) return within(pointer + "/render_mesh/file", other.errors());
        drawn = std::move(other->mesh);
    }
    BuildTimes build_times;
    BuildClock clock(build_times);
    // A generated grid is ordered row by row, which suits vector loads better than any reordering.
    const TopologyOptions options{.reorder = !std::holds_alternative<GridDesc>(cloth.mesh)};
    auto topology = build_topology(loaded->mesh, options);
    if (!topology) return within(pointer + "/mesh: " + loaded->from, topology.errors());
    clock.spent_on(BuildPart::topology);
    note_report(cloth.name, topology->report, notes);
    const ClothReserve reserve = reserve_of(cloth, topology->particle_count);

    BuiltCloth built;
    built.source.topology = options;
    built.source.numbers = std::make_shared<const ParticleNumbers>(
        ParticleNumbers{topology->particle_count, topology->welded_to_particle, topology->vertex_to_particle,
                        topology->particle_count + reserve.particles});
    const PinnedCloth placed{.mesh = loaded->mesh,
                             .numbers = *built.source.numbers,
                             .rest_positions = topology->rest_positions,
                             .positions = {}};
    auto pinned = select_pins(cloth.pins, placed, world, pointer + "/pins");
    if (!pinned) return pinned.errors();
    auto weights = weights_of(cloth.weights, placed, topology->triangles, pointer + "/weights");
    if (!weights) return weights.errors();
    built.source.pins = pinned->pins;
    if (drawn || reserve.openings) built.source.simulated = std::make_shared<const TriangleMesh>(loaded->mesh);
    built.targets = std::move(pinned->targets);
    auto model = build_cloth_model({.name = cloth.name,
                                    .mesh = std::move(loaded->mesh),
                                    .render_mesh = std::move(drawn),
                                    .start_velocity = cloth.velocity,
                                    .fabric = fabric_of(cloth),
                                    .weights = std::move(*weights),
                                    .collision = collision_of(cloth),
                                    .pins = std::move(pinned->pins),
                                    .layout = world.settings().layout(),
                                    .reserve = reserve,
                                    .build_times = build_times},
                                   std::move(*topology));
    if (!model) return within(pointer, model.errors());
    note_binding(**model, notes);
    auto paint = paint_strength(cloth, **model, at_rest(**model, built.source), pointer);
    if (!paint) return paint.errors();
    if (*paint) *model = with_tear_paint(**model, std::move(*paint));
    auto cuts = plan_cuts(cloth, **model, pointer);
    if (!cuts) return cuts.errors();
    built.source.cuts = std::move(*cuts);
    built.model = std::move(*model);
    return built;
}

namespace {

Result<std::shared_ptr<const ClothModel>> rebuild(const ClothModel& now, const ClothSource& source,
                                                  const SceneCloth& cloth, const ClothPins& pins,
                                                  const ClothLayout& layout, std::optional<ClothReserve> reserve) {
    const TriangleMesh& mesh = simulated_mesh(now, source);
    auto topology = build_topology(mesh, source.topology);
    if (!topology) return topology.errors();
    auto weights = weights_of(
        cloth.weights,
        {.mesh = mesh, .numbers = *source.numbers, .rest_positions = topology->rest_positions, .positions = {}},
        topology->triangles, "/weights");
    if (!weights) return weights.errors();
    return change_cloth_model(now, mesh, *topology,
                              {.fabric = fabric_of(cloth),
                               .weights = std::move(*weights),
                               .pins = pins,
                               .layout = layout,
                               .collision = collision_of(cloth),
                               .reserve = reserve});
}

}  // namespace

Result<std::shared_ptr<const ClothModel>> rebuild_cloth(const ClothModel& now, const ClothSource& source,
                                                        const SceneCloth& cloth, const ClothPins& pins,
                                                        const ClothLayout& layout) {
    return rebuild(now, source, cloth, pins, layout, {});
}

bool gets_room_while_it_moves(const SceneCloth& cloth, const ClothModel& model) {
    return cloth.cuts.empty() && cloth.seams.empty() && model.copied_from.empty() && model.mesh_is_of_particles() &&
           !model.parting;
}

Result<std::shared_ptr<const ClothModel>> rebuild_with_tearing(const ClothModel& now, ClothSource& source,
                                                               const SceneCloth& cloth, const ClothLayout& layout) {
    const ClothReserve reserve = reserve_of(cloth, now.particle_count);
    auto model = rebuild(now, source, cloth, source.pins, layout, reserve);
    if (!model) return model;
    // The drawn mesh follows cuts, and no longer tells what the cloth was built from.
    if (!source.simulated) source.simulated = std::make_shared<const TriangleMesh>(now.mesh());
    ParticleNumbers numbers = *source.numbers;
    numbers.first_anchor = (*model)->first_anchor();
    source.numbers = std::make_shared<const ParticleNumbers>(std::move(numbers));
    return model;
}

Result<std::uint32_t> find_triangle(std::uint32_t number, const ClothModel& model, const ClothSource& source) {
    const auto& triangles = simulated_mesh(model, source).triangles;
    if (number >= triangles.size())
        return Error{"/triangle", "must be a triangle of the mesh, 0 to " + std::to_string(triangles.size() - 1) +
                                      ", got " + std::to_string(number)};
    Triangle corners = triangles[number];
    for (std::uint32_t& corner : corners) corner = source.numbers->of_vertex[corner];
    // Triangles keep their order. Those that are left out move the later ones to lower numbers.
    const auto left_out = static_cast<std::uint32_t>(triangles.size()) - model.triangle_count;
    const std::uint32_t last = std::min(number, model.triangle_count - 1);
    for (std::uint32_t t = number - std::min(number, left_out); t <= last; ++t)
        if (model.triangles()[t] == corners) return t;
    return Error{"/triangle", "triangle " + std::to_string(number) + " is not simulated"};
}

Result<Pinned> select_pins_now(const World& world, ClothId id, const ClothSource& source,
                               const std::vector<PinDesc>& pins) {
    const Frame& frame = world.frame();
    const auto cloth = std::ranges::find(frame.cloths, id, &ClothFrame::id);
    const auto& copied_from = world.model(id)->copied_from;
    return select_pins(pins,
                       {.mesh = simulated_mesh(*world.model(id), source),
                        .numbers = *source.numbers,
                        .positions = cloth->positions,
                        .copied_from = {copied_from.data(), copied_from.size()},
                        .time = frame.time},
                       world, "/pins");
}

}  // namespace weft
