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
    bool made = false;
};

Result<LoadedMesh> load_cloth_mesh(const ClothDesc& cloth, const std::filesystem::path& scene_folder) {
    if (const auto* grid = std::get_if<GridDesc>(&cloth.mesh)) {
        return LoadedMesh{make_grid(grid->size, grid->resolution, grid->diagonal), "grid", true};
    }
    const std::string& file = std::get<MeshFileDesc>(cloth.mesh).file;
    auto path = find_asset(file, scene_folder);
    if (!path) return path.errors();
    auto mesh = load_mesh(*path);
    if (!mesh) return mesh.errors();
    return LoadedMesh{std::move(*mesh), path->string(), false};
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

Result<std::shared_ptr<const ClothModel>> make_cloth(const ClothDesc& cloth, const std::string& place,
                                                     const std::string& pointer,
                                                     const std::filesystem::path& scene_folder,
                                                     std::vector<std::string>& notes) {
    auto loaded = load_cloth_mesh(cloth, scene_folder);
    if (!loaded) return within(place + pointer + "/mesh/file", loaded.errors());
    place_mesh(loaded->mesh, cloth);
    // A generated grid comes in rows, which vector loads like better than any order found afterwards.
    auto topology = build_topology(loaded->mesh, {.reorder = !loaded->made});
    if (!topology) return within(place + pointer + "/mesh: " + loaded->from, topology.errors());
    note_report(cloth.name, topology->report, notes);

    auto pins = select_pins(cloth, loaded->mesh, *topology, pointer);
    if (!pins) {
        Errors errors;
        for (const Error& error : pins.errors()) errors.push_back({place + error.where, error.what});
        return errors;
    }
    auto model = build_cloth_model({.name = cloth.name,
                                    .mesh = std::move(loaded->mesh),
                                    .fabric = cloth.fabric,
                                    .pinned_particles = std::move(*pins)},
                                   std::move(*topology));
    if (!model) return within(place + pointer, model.errors());
    return model;
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
        draw_positions(cloth, buffers_[i].positions);
        draw_normals(cloth, buffers_[i].normals);
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
                                                                   .iterations = session.scene_.solver.iterations});

    Errors errors;
    for (std::size_t i = 0; i < session.scene_.cloths.size(); ++i) {
        auto model = make_cloth(session.scene_.cloths[i], scene_file.string() + ": ", "/cloths/" + std::to_string(i),
                                scene_file.parent_path(), session.notes_);
        if (model) {
            session.world_->add(std::move(*model));
        } else {
            errors.insert(errors.end(), model.errors().begin(), model.errors().end());
        }
    }
    if (!errors.empty()) return errors;
    for (const ColliderDesc& collider : session.scene_.colliders) session.world_->add(make_collider(collider));
    return session;
}

}  // namespace weft
