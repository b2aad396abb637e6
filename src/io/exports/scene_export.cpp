#include "io/exports/scene_export.h"

#include "io/files/atomic_file.h"
#include "io/files/overwriting.h"
#include "io/meshes/mesh_file.h"
#include "io/meshes/mesh_writer.h"
#include "io/scenes/scene_writer.h"

#include <set>
#include <string>
#include <system_error>

namespace weft {
namespace {

namespace fs = std::filesystem;

/// Calls `change` with every name of a file in the scene, which may be const.
template <class Scene, class Change>
void for_each_file(Scene& scene, Change&& change) {
    const auto in_mesh = [&](auto& mesh) {
        if (auto* file = std::get_if<MeshFileDesc>(&mesh)) change(file->file);
    };
    const auto in_material = [&](auto& material) {
        if (!material) return;
        change(material->values.color_map);
        change(material->values.normal_map);
    };
    for (auto& cloth : scene.cloths) {
        in_mesh(cloth.mesh);
        if (cloth.render_mesh) in_mesh(*cloth.render_mesh);
        in_material(cloth.material);
    }
    for (auto& collider : scene.colliders) {
        in_material(collider.material);
        with_mesh_shape(collider.shape, [&](auto& shape) { change(shape.file); });
    }
    change(scene.light.environment.file);
}

/// A name that, in a scene in the folder `to`, refers to the file that `name` refers to in `from`.
std::string renamed(const std::string& name, const fs::path& from, const fs::path& to) {
    const auto found = find_asset(name, from);
    if (!found) return name;
    if (const auto again = find_asset(name, to); again && same_file(*again, *found)) return name;
    std::error_code error;
    const fs::path absolute = fs::absolute(*found, error);
    if (error) return name;
    // Only files beside the scene get relative names.
    const bool beside = *found == from / name;
    const fs::path relative = beside ? fs::relative(absolute, fs::absolute(to), error) : fs::path();
    return error || relative.empty() ? absolute.generic_string() : relative.generic_string();
}

struct MeshToWrite {
    TriangleMesh mesh;
    fs::path path;
};

/// Names the meshes in memory and moves them out of the scene.
std::vector<MeshToWrite> name_meshes(SceneDesc& scene, const fs::path& path) {
    std::set<std::string> taken;
    for_each_file(scene, [&](std::string& name) { taken.insert(fs::path(name).filename().string()); });
    std::vector<MeshToWrite> meshes;
    std::size_t number = 0;
    const auto name = [&](MeshDesc& mesh) {
        auto* in_memory = std::get_if<TriangleMesh>(&mesh);
        if (!in_memory) return;
        std::string file;
        do {
            file = path.stem().string() + "-mesh" + std::to_string(number++) + ".ply";
        } while (taken.contains(file));
        meshes.push_back({std::move(*in_memory), folder_of(path) / file});
        mesh = MeshFileDesc{.file = file};
    };
    for (SceneCloth& cloth : scene.cloths) {
        name(cloth.mesh);
        if (cloth.render_mesh) name(*cloth.render_mesh);
    }
    for (SceneCollider& collider : scene.colliders) {
        with_mesh_shape(collider.shape, [&](auto& shape) {
            if (!shape.file.empty() || shape.mesh.triangles.empty()) return;
            MeshDesc mesh = std::exchange(shape.mesh, {});
            name(mesh);
            shape.file = std::get<MeshFileDesc>(mesh).file;
            shape.up = UpAxis::y;
        });
    }
    return meshes;
}

}  // namespace

std::vector<fs::path> files_of(const SceneDesc& scene, const fs::path& folder) {
    std::vector<fs::path> files;
    for_each_file(scene, [&](const std::string& name) {
        if (name.empty()) return;
        if (auto found = find_asset(name, folder)) files.push_back(std::move(*found));
    });
    return files;
}

Result<std::vector<fs::path>> export_scene(SceneDesc scene, const fs::path& folder, const fs::path& path) {
    for_each_file(scene, [&](std::string& name) {
        if (!name.empty()) name = renamed(name, folder, folder_of(path));
    });
    const std::vector<MeshToWrite> meshes = name_meshes(scene, path);
    const auto text = write_scene(scene);
    if (!text) return text.errors();

    std::vector<AtomicFile> files;
    const auto begin = [&](const fs::path& to) -> Result<void> {
        auto file = AtomicFile::create(to);
        if (!file) return file.errors();
        files.push_back(std::move(*file));
        return {};
    };
    if (auto begun = begin(path); !begun) return begun.errors();
    if (auto done = files.back().write(*text); !done) return done.errors();
    for (const MeshToWrite& mesh : meshes) {
        if (auto begun = begin(mesh.path); !begun) return begun.errors();
        if (auto done = write_mesh(mesh.mesh, files.back()); !done) return done.errors();
    }
    for (AtomicFile& file : files)
        if (auto done = file.prepare(); !done) return done.errors();
    // The scene is committed last, because it names the other files.
    for (std::size_t i = files.size(); i-- > 0;)
        if (auto done = files[i].commit(); !done) return done.errors();

    std::vector<fs::path> written{path};
    for (const MeshToWrite& mesh : meshes) written.push_back(mesh.path);
    return written;
}

}  // namespace weft
