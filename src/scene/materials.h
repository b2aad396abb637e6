// The materials of the cloths and colliders of a scene, including the defaults.
#pragma once

#include "scene/scene_desc.h"

#include <string>
#include <vector>

namespace weft {

/// The default material, also for materials without `preset`: for a cloth that of its fabric, for a plane `floor`, for
/// other colliders `matte`.
const MaterialPreset& default_material(const SceneCloth& cloth);
const MaterialPreset& default_material(const ColliderDesc& collider);

/// The material that the scene gives, or the default. The reference is valid as long as the argument.
const Material& material_of(const SceneCloth& cloth);
const Material& material_of(const SceneCollider& collider);

/// Where `color` is given without `weft_color`, sets `weft_color` to `color` and ignores that of the preset.
void follow_color(Material& material, bool color_given, bool weft_color_given);

/// An image file that a material or the light uses, and the JSON pointer of the key that names it.
struct PictureFile {
    std::string place, file;
};
std::vector<PictureFile> picture_files(const SceneDesc& scene);

}  // namespace weft
