// Checks of the camera, the light and the materials of a scene.
#include "scene/check.h"
#include "scene/scene_keys.h"

#include <algorithm>
#include <cmath>

namespace weft {

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

void check_material(const std::optional<SceneMaterial>& material, const std::string& pointer, Problems& problems) {
    if (material) check_values(material_parameters, &material->values, pointer, problems);
}

}  // namespace weft
