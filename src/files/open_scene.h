// Opens a scene file as a SceneWorld.
#pragma once

#include "io/scenes/scene_file.h"
#include "weft/scene_world.h"

#include <weft/files.h>

namespace weft {

/// Sets Options::read_mesh to read_mesh_file() if it is empty.
inline Options with_mesh_files(Options options) {
    if (!options.read_mesh) options.read_mesh = read_mesh_file;
    return options;
}

/// Puts the file name before JSON pointers in `where`. Errors of options have no pointer and are not changed.
inline Errors in_scene_file(const std::filesystem::path& file, Errors errors) {
    for (Error& error : errors)
        if (error.where.starts_with('/')) error.where = file.string() + ": " + error.where;
    return errors;
}

/// Returns all problems found, with their places in the scene file as `where`. `make`: used instead of make_backend(),
/// if not empty.
inline Result<SceneWorld> open_scene(const std::filesystem::path& file, const Options& options,
                                     const MakeBackend& make = {}) {
    auto scene = load_scene(file);
    if (!scene) return scene.errors();
    auto world = SceneWorld::create(std::move(*scene), with_mesh_files(options), file.parent_path(), make);
    if (!world) return in_scene_file(file, world.errors());
    return world;
}

}  // namespace weft
