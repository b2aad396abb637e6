// Writes a scene as the text from which it can be read.
#pragma once

#include "scene/scene_desc.h"

#include <weft/result.h>

#include <string>

namespace weft {

/// Text that parse_scene() reads as the same scene: keys in the order of docs/scene.md, only values that differ from
/// their defaults, numbers in the fewest digits that keep their bits. Names that cloths and colliders got only because
/// they had none are left out. File names stay unchanged.
///
/// Fails on what a file cannot hold: a mesh that is only in memory, text that is not UTF-8, a scene without cloths, and
/// more values than a scene file may have. Each error has its place, a JSON pointer.
Result<std::string> write_scene(const SceneDesc& scene);

}  // namespace weft
