// What is wrong with the camera, the light and the looks of a scene.
#include "scene/check.h"
#include "scene/nearest_name.h"
#include "scene/scene_keys.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <set>

namespace weft {
namespace {

// Whether a name that is not among them is wrong for sure: what could not be read has none.
bool names_are_known(const SceneDesc& scene, const Problems& problems) {
    const auto sound = [&](std::string_view list, std::size_t size) {
        if (!problems.concern(list)) return true;
        for (std::size_t i = 0; i < size; ++i)
            if (problems.concern(at(at(list, i), "name"))) return false;
        return size > 0;
    };
    return sound("/cloths", scene.cloths.size()) && sound("/colliders", scene.colliders.size());
}

}  // namespace

void check_camera(const Camera& camera, const std::string& pointer, Problems& problems) {
    check_values(camera_parameters, &camera, pointer, problems);
    const Vec3 along = camera.target - camera.position;
    const bool apart = std::max({std::abs(along.x), std::abs(along.y), std::abs(along.z)}) > 1e-6f;
    if (!apart && !problems.concern(pointer))
        problems.add(at(pointer, "target"), "must be another place than \"position\"");
}

void check_light(const Lighting& light, const std::string& pointer, Problems& problems) {
    check_values(lighting_parameters, &light, pointer, problems);
    check_values(sun_parameters, &light.sun, at(pointer, "sun"), problems);
    check_values(sky_parameters, &light.sky, at(pointer, "sky"), problems);
    check_values(environment_parameters, &light.environment, at(pointer, "environment"), problems);
}

void check_looks(const SceneDesc& scene, const std::string& pointer, Problems& problems) {
    if (scene.looks.empty()) return;
    const std::vector<std::string> cloths = cloth_names(scene), colliders = collider_names(scene);
    std::vector<std::string_view> names(cloths.begin(), cloths.end());
    names.insert(names.end(), colliders.begin(), colliders.end());
    const std::set<std::string_view> known(names.begin(), names.end());
    const bool sure = names_are_known(scene, problems);

    std::size_t unknown = 0;
    for (const SceneLook& look : scene.looks) {
        const std::string place = at(pointer, look.object);
        check_values(material_parameters, &look.material, place, problems);
        if (!sure || known.contains(look.object)) continue;
        // Where there are many names, or many that are wrong, a list of them helps no one.
        const bool suggests = ++unknown <= 100 && (names.size() <= 24 || !nearest_name(look.object, names).empty());
        problems.add(place, "unknown cloth or collider " + in_quotes(look.object) +
                                (suggests ? suggestion(look.object, names) : ""));
    }
}

}  // namespace weft
