// A scene back to the text that it would be read from.
#pragma once

#include "scene/scene_desc.h"

#include <weft/result.h>

#include <string>

namespace weft {

/// What parse_scene() reads as the same scene: keys in the order of docs/scene.md, only values that differ from their
/// defaults, numbers in the fewest digits that keep their bits. The names of cloths and colliders that have been given
/// one only because they had none are left out. Names of files stay as they are.
///
/// Fails on what a file cannot say: a mesh that is no file's but in memory, text that is no UTF-8, no cloth at all, and
/// more than a scene file may hold. Each error has the place, a JSON pointer.
Result<std::string> write_scene(const SceneDesc& scene);

}  // namespace weft
