#include "io/scenes/scene_look.h"

#include "scene/looks.h"
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

void use_material(const std::string& name, const std::string& place, SceneLook& look, Problems& problems) {
    if (const MaterialPreset* preset = find_material(name)) {
        look.preset = name;
        look.material = preset->material;
        return;
    }
    std::vector<std::string_view> names;
    for (const MaterialPreset& preset : material_presets()) names.push_back(preset.name);
    problems.add(place, "unknown material " + in_quotes(name) + suggestion(name, names));
}

void read_look_object(ObjectReader& o, SceneLook& look) {
    LookHead head;
    o.values(look_keys, &head);
    if (const json* material = o.find("material"); material && material->is_string())
        use_material(head.material, at(o.pointer(), "material"), look, o.problems());
    o.values(material_parameters, &look.material);
    follow_color(look.material, o.find("color") != nullptr, o.find("weft_color") != nullptr);
}

void read_looks(ObjectReader& o, SceneDesc& scene) {
    const json* found = o.find("look");
    if (!found) return;
    const std::string pointer = at(o.pointer(), "look");
    if (!found->is_object()) return o.problems().add(pointer, "must be an object, got " + json_text(*found));

    const auto defaults = default_materials(scene);
    for (const auto& [name, value] : found->items()) {
        SceneLook& look = scene.looks.emplace_back();
        look.object = name;
        if (const auto preset = defaults.find(name); preset != defaults.end()) {
            look.preset = preset->second->name;
            look.material = preset->second->material;
        }
        const std::string place = at(pointer, name);
        if (value.is_string()) {
            use_material(value.get<std::string>(), place, look, o.problems());
        } else if (value.is_object()) {
            ObjectReader keys(value, place, o.problems());
            read_look_object(keys, look);
            keys.finish();
        } else {
            o.problems().add(place, "must be the name of a material or an object, got " + json_text(value));
        }
    }
}

}  // namespace

void read_pictures(ObjectReader& o, SceneDesc& scene) {
    o.object("camera", [&](ObjectReader& camera) { camera.values(camera_parameters, &scene.camera.emplace()); });
    o.object("light", [&](ObjectReader& light) { read_light(light, scene.light); });
    read_looks(o, scene);
}

}  // namespace weft
