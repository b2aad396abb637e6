#include "io/scenes/scene_look.h"

#include "scene/materials.h"
#include "scene/nearest_name.h"
#include "scene/scene_keys.h"

#include <nlohmann/json.hpp>
#include <utility>

namespace weft {
namespace {

using nlohmann::json;

void read_light(ObjectReader& o, Lighting& light) {
    o.values(lighting_parameters, &light);
    o.object("sun", [&](ObjectReader& sun) { sun.values(sun_parameters, &light.sun); });
    o.object("sky", [&](ObjectReader& sky) { sky.values(sky_parameters, &light.sky); });
    o.object("environment", [&](ObjectReader& e) { e.values(environment_parameters, &light.environment); });
}

void use_material(const std::string& name, const std::string& place, SceneMaterial& material, Problems& problems) {
    if (const MaterialPreset* preset = find_material(name)) {
        material = {.preset = name, .values = preset->material};
        return;
    }
    std::vector<std::string_view> names;
    for (const MaterialPreset& preset : material_presets()) names.push_back(preset.name);
    problems.add(place, "unknown material " + in_quotes(name) + suggestion(name, names));
}

void read_material_object(ObjectReader& o, SceneMaterial& material) {
    MaterialHead head;
    o.values(material_keys, &head);
    if (const json* preset = o.find("preset"); preset && preset->is_string())
        use_material(head.preset, at(o.pointer(), "preset"), material, o.problems());
    o.values(material_parameters, &material.values);
    follow_color(material.values, o.find("color") != nullptr, o.find("weft_color") != nullptr);
}

}  // namespace

void read_material(ObjectReader& o, const MaterialPreset& otherwise, std::optional<SceneMaterial>& material) {
    const json* found = o.find("material");
    if (!found) return;
    material = {.preset = std::string(otherwise.name), .values = otherwise.material};
    const std::string place = at(o.pointer(), "material");
    if (found->is_string())
        use_material(found->get<std::string>(), place, *material, o.problems());
    else if (found->is_object())
        o.object("material", [&](ObjectReader& keys) { read_material_object(keys, *material); });
    else
        o.problems().add(place, "must be the name of a material or an object, got " + json_text(*found));
}

void read_pictures(ObjectReader& o, SceneDesc& scene) {
    o.object("camera", [&](ObjectReader& camera) { camera.values(camera_parameters, &scene.camera.emplace()); });
    o.object("light", [&](ObjectReader& light) { read_light(light, scene.light); });
}

}  // namespace weft
