// Writes a scene to a file from which it can be read again, and meshes that are only in memory to files beside it.
#pragma once

#include "scene/scene_desc.h"

#include <weft/result.h>

#include <filesystem>
#include <vector>

namespace weft {

/// Writes `scene` to `path` and, for `scenes/a.json`, each mesh in memory to `scenes/a-mesh0.ply`,
/// `scenes/a-mesh1.ply`, …; names that the scene already uses are skipped. Either all files appear, or none.
///
/// `folder`: where the scene finds its files now. File names are changed where this is needed to find the same files
/// from the new folder: relative to it for files in `folder`, absolute for others that would not be found there. Names
/// of missing files stay unchanged.
///
/// Returns the files in the order of their names in the scene, the scene itself first.
Result<std::vector<std::filesystem::path>> export_scene(SceneDesc scene, const std::filesystem::path& folder,
                                                        const std::filesystem::path& path);

/// The existing files that the scene names: meshes and images, as find_asset() finds them from `folder`.
std::vector<std::filesystem::path> files_of(const SceneDesc& scene, const std::filesystem::path& folder);

}  // namespace weft
