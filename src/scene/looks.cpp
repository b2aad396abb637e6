#include "scene/looks.h"

#include "scene/check.h"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <string_view>
#include <variant>

namespace weft {
namespace {

const MaterialPreset& material_or(std::string_view name, std::string_view otherwise) {
    const MaterialPreset* found = find_material(name);
    if (!found) found = find_material(otherwise);
    assert(found);
    return *found;
}

template <class Thing>
Material look_of_thing(const SceneDesc& scene, const Thing& thing) {
    const auto found = std::ranges::find(scene.looks, thing.name, &SceneLook::object);
    return found != scene.looks.end() ? found->material : default_material(thing).material;
}

}  // namespace

const MaterialPreset& default_material(const SceneCloth& cloth) {
    const FabricPreset* fabric = find_fabric(cloth.fabric_name);
    return material_or(fabric ? fabric->material : "", "cotton");
}

const MaterialPreset& default_material(const ColliderDesc& collider) {
    return material_or(std::holds_alternative<PlaneDesc>(collider.shape) ? "floor" : "matte", "matte");
}

std::map<std::string, const MaterialPreset*> default_materials(const SceneDesc& scene) {
    std::map<std::string, const MaterialPreset*> materials;
    const std::vector<std::string> cloths = cloth_names(scene), colliders = collider_names(scene);
    for (std::size_t i = 0; i < cloths.size(); ++i) materials.emplace(cloths[i], &default_material(scene.cloths[i]));
    for (std::size_t i = 0; i < colliders.size(); ++i)
        materials.emplace(colliders[i], &default_material(scene.colliders[i]));
    return materials;
}

Material look_of(const SceneDesc& scene, const SceneCloth& cloth) {
    return look_of_thing(scene, cloth);
}

Material look_of(const SceneDesc& scene, const ColliderDesc& collider) {
    return look_of_thing(scene, collider);
}

Material look_of(const SceneDesc& scene, const std::string& object_name) {
    const auto cloth = std::ranges::find(scene.cloths, object_name, &SceneCloth::name);
    if (cloth != scene.cloths.end()) return look_of(scene, *cloth);
    const auto collider = std::ranges::find(scene.colliders, object_name, &ColliderDesc::name);
    if (collider != scene.colliders.end()) return look_of(scene, *collider);
    return material_or("matte", "matte").material;
}

void follow_color(Material& material, bool color_given, bool weft_color_given) {
    // A color out of range is one problem, not two.
    Problems of_color;
    check_values(material_parameters, &material, "", of_color);
    if (color_given && !weft_color_given && !of_color.concern("/color")) material.weft_color = material.color;
}

std::vector<PictureFile> picture_files(const SceneDesc& scene) {
    std::vector<PictureFile> files;
    const auto add = [&](const std::string& pointer, std::string_view key, const std::string& file) {
        if (!file.empty()) files.push_back({at(pointer, key), file});
    };
    add("/light/environment", "file", scene.light.environment.file);
    for (const SceneLook& look : scene.looks) {
        add(at("/look", look.object), "color_map", look.material.color_map);
        add(at("/look", look.object), "normal_map", look.material.normal_map);
    }
    return files;
}

}  // namespace weft
