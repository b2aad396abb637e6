// Reads the parts of a scene file that concern images: camera, light and materials.
#pragma once

#include "io/scenes/json_reader.h"
#include "scene/scene_desc.h"

#include <optional>

namespace weft {

/// `camera` and `light`.
void read_pictures(ObjectReader& o, SceneDesc& scene);

/// Reads `material` of a cloth or a collider. `otherwise`: the preset of a material that names none.
void read_material(ObjectReader& o, const MaterialPreset& otherwise, std::optional<SceneMaterial>& material);

}  // namespace weft
