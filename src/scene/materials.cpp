#include "scene/materials.h"

#include "scene/check.h"

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

template <class Object>
const Material& given_or_default(const Object& object) {
    return object.material ? object.material->values : default_material(object).material;
}

}  // namespace

const MaterialPreset& default_material(const SceneCloth& cloth) {
    const FabricPreset* fabric = find_fabric(cloth.fabric_name);
    return material_or(fabric ? fabric->material : "", "cotton");
}

const MaterialPreset& default_material(const ColliderDesc& collider) {
    return material_or(std::holds_alternative<PlaneDesc>(collider.shape) ? "floor" : "matte", "matte");
}

const Material& material_of(const SceneCloth& cloth) {
    return given_or_default(cloth);
}

const Material& material_of(const SceneCollider& collider) {
    return given_or_default(collider);
}

void follow_color(Material& material, bool color_given, bool weft_color_given) {
    // A color out of range is reported once: `weft_color` does not follow it then.
    Problems of_color;
    check_values(material_parameters, &material, "", of_color);
    if (color_given && !weft_color_given && !of_color.concern("/color")) material.weft_color = material.color;
}

std::vector<PictureFile> picture_files(const SceneDesc& scene) {
    std::vector<PictureFile> files;
    const auto add = [&](const std::string& pointer, std::string_view key, const std::string& file) {
        if (!file.empty()) files.push_back({at(pointer, key), file});
    };
    const auto add_maps = [&](const std::optional<SceneMaterial>& material, const std::string& pointer) {
        if (!material) return;
        add(at(pointer, "material"), "color_map", material->values.color_map);
        add(at(pointer, "material"), "normal_map", material->values.normal_map);
    };
    add("/light/environment", "file", scene.light.environment.file);
    for (std::size_t i = 0; i < scene.cloths.size(); ++i) add_maps(scene.cloths[i].material, at("/cloths", i));
    for (std::size_t i = 0; i < scene.colliders.size(); ++i) add_maps(scene.colliders[i].material, at("/colliders", i));
    return files;
}

}  // namespace weft
