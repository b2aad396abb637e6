// A scene file as a world that runs it.
#pragma once

#include "io/scenes/scene_file.h"
#include "weft/scene_world.h"

#include <weft/files.h>

namespace weft {

/// With read_mesh_file() where the options have no other.
inline Options with_mesh_files(Options options) {
    if (!options.read_mesh) options.read_mesh = read_mesh_file;
    return options;
}

/// `where` of problems of a scene as places in its file. What is wrong with options the file cannot help.
inline Errors in_scene_file(const std::filesystem::path& file, Errors errors) {
    for (Error& error : errors)
        if (error.where.starts_with('/')) error.where = file.string() + ": " + error.where;
    return errors;
}

/// Every problem found has its place in the scene file as `where`. `make`: in place of make_backend().
inline Result<SceneWorld> open_scene(const std::filesystem::path& file, const Options& options,
                                     const MakeBackend& make = {}) {
    auto scene = load_scene(file);
    if (!scene) return scene.errors();
    auto world = SceneWorld::create(std::move(*scene), with_mesh_files(options), file.parent_path(), make);
    if (!world) return in_scene_file(file, world.errors());
    return world;
}

}  // namespace weft
