// How the things of a scene look, also where it does not say so.
#pragma once

#include "scene/scene_desc.h"

#include <map>
#include <string>
#include <vector>

namespace weft {

/// The material of a thing without a look, or whose look names none: of a cloth that which its fabric has, of a plane
/// `floor`, of other colliders `matte`.
const MaterialPreset& default_material(const SceneCloth& cloth);
const MaterialPreset& default_material(const ColliderDesc& collider);
/// The same for everything in the scene by its name. A name that a cloth and a collider share is the cloth's.
std::map<std::string, const MaterialPreset*> default_materials(const SceneDesc& scene);

/// By the scene's look for what is called so, otherwise by the material above.
Material look_of(const SceneDesc& scene, const SceneCloth& cloth);
Material look_of(const SceneDesc& scene, const ColliderDesc& collider);
/// By name alone; what there is not is `matte`.
Material look_of(const SceneDesc& scene, const std::string& object_name);

/// Where a description gives the color and not that of the weft, both are the same, whatever the preset's weft is.
void follow_color(Material& material, bool color_given, bool weft_color_given);

/// A file that looks or the light take a picture from, and where it is named: a JSON pointer.
struct PictureFile {
    std::string place, file;
};
std::vector<PictureFile> picture_files(const SceneDesc& scene);

}  // namespace weft
