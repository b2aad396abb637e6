// A scene to a file from which it can be read again, with the meshes that are in no file yet beside it.
#pragma once

#include "scene/scene_desc.h"

#include <weft/result.h>

#include <filesystem>
#include <vector>

namespace weft {

/// Writes `scene` to `path` and, for `scenes/a.json`, each mesh that lies in memory to `scenes/a-mesh0.ply`,
/// `scenes/a-mesh1.ply`, …; numbers that the scene itself names already are left out. All appear, or none.
///
/// `folder`: where the scene looks for its files now. Names of files are changed where that is needed to find the same
/// ones from the new folder: relative to it for those in `folder`, absolute for others that would not be found there.
/// Names of files that are not found stay as they are.
///
/// Returns the files in the order of their names in the scene, the scene itself first.
Result<std::vector<std::filesystem::path>> export_scene(SceneDesc scene, const std::filesystem::path& folder,
                                                        const std::filesystem::path& path);

}  // namespace weft
