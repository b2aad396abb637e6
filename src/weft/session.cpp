#include "weft/session.h"

#include "io/meshes/mesh_file.h"
#include "io/scenes/scene_file.h"
#include "mesh/topology.h"
#include "scene/check.h"
#include "scene/nearest_name.h"
#include "scene/scene_keys.h"
#include "weft/backends.h"
#include "weft/placement.h"

#include <algorithm>
#include <cassert>
#include <type_traits>

namespace weft {
namespace {

struct LoadedMesh {
    TriangleMesh mesh;
    std::string from;  // what errors about it call it
};

Result<LoadedMesh> load(const GridDesc& grid, const std::filesystem::path&) {
    return LoadedMesh{make_grid(grid.size, grid.resolution, grid.diagonal), "grid"};
}
Result<LoadedMesh> load(const SphereMeshDesc& sphere, const std::filesystem::path&) {
    return LoadedMesh{make_sphere(sphere.radius, sphere.subdivisions), "sphere"};
}
Result<LoadedMesh> load(const BoxMeshDesc& box, const std::filesystem::path&) {
    return LoadedMesh{make_box(box.size, box.resolution), "box"};
}
Result<LoadedMesh> load(const TriangleMesh& mesh, const std::filesystem::path&) {
    return LoadedMesh{mesh, "mesh"};
}
Result<LoadedMesh> load(const MeshFileDesc& desc, const std::filesystem::path& scene_folder) {
    auto path = find_asset(desc.file, scene_folder);
    if (!path) return path.errors();
    auto mesh = load_mesh(*path);
    if (!mesh) return mesh.errors();
    return LoadedMesh{std::move(*mesh), path->string()};
}

// Placed in the world.
Result<LoadedMesh> load_placed(const MeshDesc& desc, const TransformDesc& transform,
                               const std::filesystem::path& scene_folder) {
    auto loaded = std::visit([&](const auto& shape) { return load(shape, scene_folder); }, desc);
    if (loaded) place_mesh(loaded->mesh, desc, transform);
    return loaded;
}

// `where` of what lies deeper, put behind the place in the scene.
Errors within(const std::string& place, const Errors& errors) {
    Errors placed;
    for (const Error& error : errors) placed.push_back({place, error.message(), error.fault});
    return placed;
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

// Two meshes that do not lie over each other come of a wrong scale or axis more often than of a wish.
void note_binding(const ClothModel& model, std::vector<std::string>& notes) {
    constexpr float far_apart = 0.1f;  // of the extent: no lining, trimming or decimated mesh is so far off
    Bounds bounds;
    for (std::uint32_t p = 0; p < model.particle_count; ++p) bounds.include(model.rest_position(p));
    const float extent = length(bounds.size());
    if (model.binding.farthest > far_apart * extent)
        notes.push_back("cloth '" + model.name + "': the drawn mesh lies up to " + number_text(model.binding.farthest) +
                        " m away from the simulated one");
}

// What a scene says of tethers beside the fabric is a material like any other to the solver.
Fabric fabric_of(const SceneCloth& cloth) {
    Fabric fabric = cloth.fabric;
    fabric.tether = {cloth.tethers, cloth.tether_slack};
    return fabric;
}

std::unique_ptr<TriangleMesh> keep_if(bool wanted, const TriangleMesh& mesh) {
    return wanted ? std::make_unique<TriangleMesh>(mesh) : nullptr;
}

Errors apply(const Options& options, SceneDesc& scene) {
    Errors errors;
    const auto set = [&](const std::optional<std::uint32_t>& from, std::uint32_t& to, const char* name) {
        if (!from) return;
        if (*from < 1 || *from > 10000) {
            errors.push_back({name, "must be from 1 to 10000, got " + std::to_string(*from)});
        }
        to = *from;
    };
    const auto choose = [&](const std::string& from, const auto& names, auto& to, const char* name) {
        if (from.empty()) return;
        const auto it = std::ranges::find(names, from);
        if (it == names.end()) {
            errors.push_back({name, "must be " + alternatives(names) + ", got " + in_quotes(from)});
        } else {
            to = static_cast<std::remove_reference_t<decltype(to)>>(it - names.begin());
        }
    };
    const auto names_of = [](std::string_view key) {
        return choice_names(*std::ranges::find(solver_keys, key, &Parameter::key));
    };
    choose(options.method, names_of("method"), scene.solver.method, "method");
    choose(options.projection, names_of("projection"), scene.solver.projection, "projection");
    choose(options.accumulate, names_of("accumulate"), scene.solver.accumulate, "accumulate");
    if (options.hierarchy) scene.solver.hierarchy = *options.hierarchy;
    set(options.substeps, scene.solver.substeps, "substeps");
    set(options.iterations, scene.solver.iterations, "iterations");
    if (options.threads < 1 || options.threads > 256) {
        errors.push_back({"threads", "must be from 1 to 256, got " + std::to_string(options.threads)});
    }
    return errors;
}

const Material* material_of(const ClothFrame& cloth, std::span<const SceneLook> looks) {
    const auto look = std::ranges::find(looks, cloth.model->name, &SceneLook::object);
    if (look != looks.end()) return &look->material;
    return cloth.render_mesh().colors.empty() ? &find_material("cotton")->material : nullptr;
}

}  // namespace

void DrawnFrame::update(const Frame& frame, std::span<const SceneLook> looks) {
    surfaces_.resize(frame.cloths.size());
    for (std::size_t i = 0; i < frame.cloths.size(); ++i) {
        const ClothFrame& cloth = frame.cloths[i];
        const RenderMesh& mesh = cloth.render_mesh();
        surfaces_[i] = {.name = cloth.model->name,
                        .positions = mesh.positions,
                        .normals = mesh.normals,
                        .triangles = mesh.triangles,
                        .uvs = mesh.uvs,
                        .colors = mesh.colors,
                        .rest_positions = mesh.rest_positions,
                        .topology_version = cloth.topology_version,
                        .material = material_of(cloth, looks)};
    }
}

struct Session::Entry {
    ClothId id;
    SceneCloth desc;                          ///< without its meshes
    std::unique_ptr<TriangleMesh> simulated;  ///< where that is not the one that is drawn
    TopologyOptions topology;                 ///< how it was made, and is made again for a change
    ClothPins pins;
    Holds holds;
};

Session::Session() = default;
Session::Session(Session&&) noexcept = default;
Session& Session::operator=(Session&&) noexcept = default;
Session::~Session() = default;

Result<Session> Session::create(SceneDesc scene, const Options& options, const std::filesystem::path& folder,
                                const MakeBackend& make) {
    Session session;
    if (Errors errors = apply(options, scene); !errors.empty()) return errors;
    auto backend = make ? make(options) : make_backend(options);
    if (!backend) return backend.errors();
    session.folder_ = folder;
    session.world_ = std::make_unique<World>(std::move(*backend), WorldSettings{.gravity = scene.gravity,
                                                                                .substeps = scene.solver.substeps,
                                                                                .iterations = scene.solver.iterations,
                                                                                .method = scene.solver.method,
                                                                                .projection = scene.solver.projection,
                                                                                .accumulate = scene.solver.accumulate,
                                                                                .hierarchy = scene.solver.hierarchy,
                                                                                .air = scene.air,
                                                                                .feedback = options.feedback});
    for (const ColliderDesc& collider : scene.colliders) session.world_->add(make_collider(collider));
    Errors errors;
    for (std::size_t i = 0; i < scene.cloths.size(); ++i) {
        auto added = session.add(scene.cloths[i], "/cloths/" + std::to_string(i));
        if (!added) errors.insert(errors.end(), added.errors().begin(), added.errors().end());
    }
    if (!errors.empty()) return errors;
    session.scene_ = std::move(scene);
    return session;
}

Result<Session> Session::open(const std::filesystem::path& scene_file, const Options& options,
                              const MakeBackend& make) {
    auto scene = load_scene(scene_file);
    if (!scene) return scene.errors();
    auto session = create(std::move(*scene), options, scene_file.parent_path(), make);
    if (session) return session;
    Errors errors;
    for (const Error& error : session.errors()) {
        // What options are wrong the file cannot help.
        const bool of_file = error.where.starts_with('/');
        errors.push_back(of_file ? Error{scene_file.string() + ": " + error.where, error.what, error.fault} : error);
    }
    return errors;
}

Result<ClothId> Session::add(const SceneCloth& cloth, const std::string& pointer) {
    auto loaded = load_placed(cloth.mesh, cloth.transform, folder_);
    if (!loaded) return within(pointer + "/mesh/file", loaded.errors());
    std::optional<TriangleMesh> drawn;
    if (cloth.drawn) {
        auto other = load_placed(*cloth.drawn, cloth.transform, folder_);
        if (!other) return within(pointer + "/drawn/file", other.errors());
        drawn = std::move(other->mesh);
    }
    // A generated grid comes in rows, which vector loads like better than any order found afterwards.
    BuildTimes build_times;
    BuildClock clock(build_times);
    const TopologyOptions options{.reorder = !std::holds_alternative<GridDesc>(cloth.mesh)};
    auto topology = build_topology(loaded->mesh, options);
    if (!topology) return within(pointer + "/mesh: " + loaded->from, topology.errors());
    clock.spent_on(BuildPart::topology);
    note_report(cloth.name, topology->report, notes_);

    auto pinned = select_pins(cloth.pins, {loaded->mesh, *topology, {}}, *world_, pointer + "/pins");
    if (!pinned) return pinned.errors();
    Entry entry{.id = {},
                .desc = cloth,
                .simulated = keep_if(drawn.has_value(), loaded->mesh),
                .topology = options,
                .pins = {},
                .holds = {}};
    entry.desc.mesh = {}, entry.desc.drawn = {};
    entry.pins = pinned->pins;
    entry.holds = pinned->holds;
    auto model = build_cloth_model({.name = cloth.name,
                                    .mesh = std::move(loaded->mesh),
                                    .drawn = std::move(drawn),
                                    .fabric = fabric_of(cloth),
                                    .pins = std::move(pinned->pins),
                                    .layout = world_->settings().layout(),
                                    .build_times = build_times},
                                   std::move(*topology));
    if (!model) return within(pointer, model.errors());
    note_binding(**model, notes_);
    auto id = world_->try_add(std::move(*model), std::move(pinned->holds));
    if (!id) return id.errors();
    entry.id = *id;
    entries_.push_back(std::move(entry));
    return entries_.back().id;
}

void Session::remove(ClothId id) {
    std::erase_if(entries_, [&](const Entry& entry) { return entry.id == id; });
    world_->remove(id);
}

Result<Done> Session::rebuild(Entry& entry, const SceneCloth& desc, const ClothPins& pins, Holds holds) {
    const ClothModel& now = *world_->model(entry.id);
    const TriangleMesh& mesh = entry.simulated ? *entry.simulated : now.mesh();
    auto topology = build_topology(mesh, entry.topology);
    if (!topology) return topology.errors();
    auto model = change_cloth_model(now, mesh, *topology, fabric_of(desc), pins, world_->settings().layout());
    if (!model) return model.errors();
    if (auto set = world_->set_model(entry.id, std::move(*model), holds); !set) return set;
    entry.desc = desc;
    entry.pins = pins;
    entry.holds = std::move(holds);
    return Done{};
}

Session::Entry& Session::entry(ClothId id) {
    const auto it = std::ranges::find(entries_, id, &Entry::id);
    assert(it != entries_.end());
    return *it;
}

Result<Done> Session::configure(const WorldSettings& settings) {
    const ClothLayout before = world_->settings().layout(), after = settings.layout();
    world_->configure(settings);
    for (Entry& one : entries_) {
        if (after == before) break;
        if (auto done = rebuild(one, SceneCloth(one.desc), ClothPins(one.pins), Holds(one.holds)); !done) return done;
    }
    return Done{};
}

Result<Done> Session::set_fabric(ClothId id, const Fabric& fabric, const std::string& name) {
    Entry& one = entry(id);
    SceneCloth desc = one.desc;
    desc.fabric = fabric;
    desc.fabric_name = name;
    return rebuild(one, desc, ClothPins(one.pins), Holds(one.holds));
}

Result<Done> Session::set_pins(ClothId id, std::vector<PinDesc> pins) {
    Entry& one = entry(id);
    const ClothModel& model = *world_->model(id);
    const auto cloths = std::span(world_->frame().cloths);
    const auto frame = std::ranges::find(cloths, id, &ClothFrame::id);
    const TriangleMesh& mesh = one.simulated ? *one.simulated : model.mesh();
    auto topology = build_topology(mesh, one.topology);
    if (!topology) return topology.errors();
    const PinnedCloth cloth{mesh, *topology, frame->positions, world_->frame().time};
    auto pinned = select_pins(pins, cloth, *world_, "/pins");
    if (!pinned) return pinned.errors();
    SceneCloth desc = one.desc;
    desc.pins = std::move(pins);
    return rebuild(one, desc, pinned->pins, std::move(pinned->holds));
}

}  // namespace weft
