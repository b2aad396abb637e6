// Reads scene files: JSON with comments, as docs/scene.md describes them.
#pragma once

#include "scene/scene_desc.h"

#include <weft/result.h>

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string_view>

namespace weft {

/// Reads and checks a scene. Fails with all problems of the file, each with its place: `scenes/flag.json:
/// /cloths/0/fabric/density`. Names of mesh files stay as written; their existence is not checked here.
Result<SceneDesc> load_scene(const std::filesystem::path& path);

/// The same for a text; `name` is its name in error messages.
Result<SceneDesc> parse_scene(std::string_view text, std::string_view name);

/// The same for a value that parse_json() returned. A scene without cloths is valid here, because cloths can be added
/// to it later.
Result<SceneDesc> read_scene(const nlohmann::json& value, std::string_view name);

/// The text of a scene file, at most as long as a scene may be. Fails if it cannot be read.
Result<std::string> read_scene_text(const std::filesystem::path& path);

}  // namespace weft
