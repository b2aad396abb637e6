#include "io/exports/scene_export.h"

#include "io/files/atomic_file.h"
#include "io/meshes/mesh_file.h"
#include "io/meshes/mesh_writer.h"
#include "io/scenes/scene_writer.h"

#include <functional>
#include <set>
#include <string>
#include <system_error>

namespace weft {
namespace {

namespace fs = std::filesystem;

/// Calls `change` with every name of a file in the scene.
void for_each_file(SceneDesc& scene, const std::function<void(std::string&)>& change) {
    const auto in_mesh = [&](MeshDesc& mesh) {
        if (auto* file = std::get_if<MeshFileDesc>(&mesh)) change(file->file);
    };
    for (SceneCloth& cloth : scene.cloths) {
        in_mesh(cloth.mesh);
        if (cloth.drawn) in_mesh(*cloth.drawn);
    }
    change(scene.light.environment.file);
    for (SceneLook& look : scene.looks) {
        change(look.material.color_map);
        change(look.material.normal_map);
    }
}

bool same_file(const fs::path& a, const fs::path& b) {
    std::error_code error;
    return fs::equivalent(a, b, error) && !error;
}

/// What names, in a scene in the folder `to`, the file that `name` names in `from`.
std::string renamed(const std::string& name, const fs::path& from, const fs::path& to) {
    const auto found = find_asset(name, from);
    if (!found) return name;
    if (const auto again = find_asset(name, to); again && same_file(*again, *found)) return name;
    std::error_code error;
    const fs::path absolute = fs::absolute(*found, error);
    if (error) return name;
    // Only what lies by the scene moves with it.
    const bool beside = *found == from / name;
    const fs::path relative = beside ? fs::relative(absolute, fs::absolute(to), error) : fs::path();
    return error || relative.empty() ? absolute.generic_string() : relative.generic_string();
}

struct MeshToWrite {
    TriangleMesh mesh;
    fs::path path;
};

/// Gives names to meshes in memory, and takes them out.
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
        if (cloth.drawn) name(*cloth.drawn);
    }
    return meshes;
}

}  // namespace

Result<std::vector<fs::path>> export_scene(SceneDesc scene, const fs::path& folder, const fs::path& path) {
    for_each_file(scene, [&](std::string& name) {
        if (!name.empty()) name = renamed(name, folder, folder_of(path));
    });
    const std::vector<MeshToWrite> meshes = name_meshes(scene, path);
    const auto text = write_scene(scene);
    if (!text) return text.errors();

    std::vector<AtomicFile> files;
    const auto begin = [&](const fs::path& to) -> Result<Done> {
        auto file = AtomicFile::create(to);
        if (!file) return file.errors();
        files.push_back(std::move(*file));
        return Done{};
    };
    if (auto begun = begin(path); !begun) return begun.errors();
    if (auto done = files.back().write(*text); !done) return done.errors();
    for (const MeshToWrite& mesh : meshes) {
        if (auto begun = begin(mesh.path); !begun) return begun.errors();
        if (auto done = write_mesh(mesh.mesh, files.back()); !done) return done.errors();
    }
    for (AtomicFile& file : files)
        if (auto done = file.prepare(); !done) return done.errors();
    // The scene last: it names the others.
    for (std::size_t i = files.size(); i-- > 0;)
        if (auto done = files[i].commit(); !done) return done.errors();

    std::vector<fs::path> written{path};
    for (const MeshToWrite& mesh : meshes) written.push_back(mesh.path);
    return written;
}

}  // namespace weft
