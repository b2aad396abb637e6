#include "weft/session.h"

#include "cpu/cpu_backend.h"
#include "io/mesh_file.h"
#include "io/scene_file.h"
#include "mesh/topology.h"
#include "scene/check.h"
#include "weft/placement.h"

#include <algorithm>

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
    for (const Error& error : errors) placed.push_back({place, error.message()});
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
    const float extent = length(bounds_of(model.topology.rest_positions).size());
    if (model.binding.farthest > far_apart * extent)
        notes.push_back("cloth '" + model.name + "': the drawn mesh lies up to " + number_text(model.binding.farthest) +
                        " m away from the simulated one");
}

// What a scene says of tethers beside the fabric is a material like any other to the solver.
Fabric fabric_of(const ClothDesc& cloth) {
    Fabric fabric = cloth.fabric;
    fabric.tether = {cloth.tethers, cloth.tether_slack};
    return fabric;
}

struct MadeCloth {
    std::shared_ptr<const ClothModel> model;
    Holds holds;
};

Result<MadeCloth> make_cloth(const ClothDesc& cloth, const std::string& place, const std::string& pointer,
                             const World& world, const std::filesystem::path& scene_folder,
                             std::vector<std::string>& notes) {
    auto loaded = load_placed(cloth.mesh, cloth.transform, scene_folder);
    if (!loaded) return within(place + pointer + "/mesh/file", loaded.errors());
    std::optional<TriangleMesh> drawn;
    if (cloth.drawn) {
        auto other = load_placed(*cloth.drawn, cloth.transform, scene_folder);
        if (!other) return within(place + pointer + "/drawn/file", other.errors());
        drawn = std::move(other->mesh);
    }
    // A generated grid comes in rows, which vector loads like better than any order found afterwards.
    auto topology = build_topology(loaded->mesh, {.reorder = !std::holds_alternative<GridDesc>(cloth.mesh)});
    if (!topology) return within(place + pointer + "/mesh: " + loaded->from, topology.errors());
    note_report(cloth.name, topology->report, notes);

    auto pins = select_pins(cloth, loaded->mesh, *topology, world, pointer);
    if (!pins) {
        Errors errors;
        for (const Error& error : pins.errors()) errors.push_back({place + error.where, error.what});
        return errors;
    }
    auto model = build_cloth_model({.name = cloth.name,
                                    .mesh = std::move(loaded->mesh),
                                    .drawn = std::move(drawn),
                                    .fabric = fabric_of(cloth),
                                    .pinned_particles = std::move(pins->particles),
                                    .attachments = std::move(pins->attachments)},
                                   std::move(*topology));
    if (!model) return within(place + pointer, model.errors());
    note_binding(**model, notes);
    return MadeCloth{std::move(*model), std::move(pins->holds)};
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
    set(options.substeps, scene.solver.substeps, "substeps");
    set(options.iterations, scene.solver.iterations, "iterations");
    if (options.threads < 1 || options.threads > 256) {
        errors.push_back({"threads", "must be from 1 to 256, got " + std::to_string(options.threads)});
    }
    if (options.backend != "auto" && options.backend != "cpu") {
        errors.push_back({"backend", "must be auto or cpu, got '" + options.backend + "'"});
    }
    return errors;
}

}  // namespace

void DrawnFrame::update(const Frame& frame) {
    buffers_.resize(frame.cloths.size());
    surfaces_.resize(frame.cloths.size());
    for (std::size_t i = 0; i < frame.cloths.size(); ++i) {
        const ClothFrame& cloth = frame.cloths[i];
        draw_surface(cloth, buffers_[i].positions, buffers_[i].normals);
        surfaces_[i] = {cloth.model->name, &cloth.model->mesh, buffers_[i].positions, buffers_[i].normals};
    }
}

Result<Session> Session::open(const std::filesystem::path& scene_file, const Options& options) {
    auto scene = load_scene(scene_file);
    if (!scene) return scene.errors();
    Session session;
    session.scene_ = std::move(*scene);
    if (Errors errors = apply(options, session.scene_); !errors.empty()) return errors;

    auto backend = make_cpu_backend({.workers = options.threads - 1, .isa = options.isa});
    if (!backend) return backend.errors();
    session.world_ =
        std::make_unique<World>(std::move(*backend), WorldSettings{.gravity = session.scene_.gravity,
                                                                   .substeps = session.scene_.solver.substeps,
                                                                   .iterations = session.scene_.solver.iterations,
                                                                   .method = session.scene_.solver.method,
                                                                   .projection = session.scene_.solver.projection,
                                                                   .air = session.scene_.air});

    for (const ColliderDesc& collider : session.scene_.colliders) session.world_->add(make_collider(collider));
    Errors errors;
    for (std::size_t i = 0; i < session.scene_.cloths.size(); ++i) {
        auto cloth = make_cloth(session.scene_.cloths[i], scene_file.string() + ": ", "/cloths/" + std::to_string(i),
                                *session.world_, scene_file.parent_path(), session.notes_);
        if (cloth) {
            session.world_->add(std::move(cloth->model), std::move(cloth->holds));
        } else {
            errors.insert(errors.end(), cloth.errors().begin(), cloth.errors().end());
        }
    }
    if (!errors.empty()) return errors;
    return session;
}

}  // namespace weft
