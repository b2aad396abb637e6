#include "render/frame_data.h"

#include "look/view_limits.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>

namespace weft::render {
namespace {

using namespace shading;

vec3 as_glm(Vec3 v) {
    return {v.x, v.y, v.z};
}

constexpr float occlusion_reaches = 0.2f;  // in units of the distance from the eye to the target

/// Right-handed, y down in the image, depth from 0 to 1.
mat4 perspective(float fov, float aspect, float nearby, float far) {
    const float f = 1 / std::tan(fov / 2);
    mat4 m(0);
    m[0][0] = f / aspect;
    m[1][1] = -f;
    m[2][2] = far / (nearby - far);
    m[2][3] = -1;
    m[3][2] = nearby * far / (nearby - far);
    return m;
}

mat4 view_of(const Camera& camera) {
    return lookAt(as_glm(camera.position), as_glm(camera.target), as_glm(image_up(camera)));
}

}  // namespace

FrameData frame_data(const Drawing& drawing, const Surroundings& around, const FrameShape& shape) {
    const Camera& camera = drawing.camera;
    const Lighting& light = drawing.lighting;
    const vec3 eye = as_glm(camera.position), target = as_glm(camera.target);
    const float distance = std::max(length(target - eye), least_target_distance);
    const vec2 size(shape.width, shape.height);
    FrameData data{};
    data.to_view = view_of(camera);
    const mat4 shift = translate(mat4(1), vec3(2.0f * shape.jitter / size, 0));
    data.to_clip = shift *
                   perspective(radians(camera.fov), size.x / size.y, near_plane * distance, far_plane * distance) *
                   data.to_view;
    data.from_clip = inverse(data.to_clip);
    data.eye = vec4(eye, near_plane * distance);
    data.target = vec4(target, distance);
    data.sun = vec4(as_glm(direction_of(light.sun)), std::tan(radians(light.sun.angular_diameter) / 2));
    data.sun_color = vec4(as_glm(light.sun.color) * (light.sun.intensity * pi), light.sun.intensity > 0 ? 1.0f : 0.0f);
    std::ranges::copy(around.around, data.around);
    data.size = vec4(size, 1.0f / size);
    data.light = vec4(std::exp2(light.exposure), light.ambient_occlusion, occlusion_reaches * distance, shape.number);
    const float turn = radians(light.environment.rotation);
    data.environment = vec4(light.environment.intensity, std::cos(turn), std::sin(turn),
                            static_cast<float>(around.mirrored.size()) - 1);
    data.background = vec4(drawing.background == Background::transparent ? 1.0f : 0.0f,
                           shape.has_environment && light.environment.visible ? 1.0f : 0.0f,
                           ground_begins_to_fade * distance, ground_ends * distance);
    const Vec3 colors[] = {light.sky.zenith, light.sky.horizon, light.sky.ground};
    for (int i = 0; i < 3; ++i) data.sky[i] = vec4(as_glm(colors[i]) * light.sky.intensity, 0);
    return data;
}

ObjectData object_data(const Object& object) {
    ObjectData data{};
    data.positions = object.surface.positions.address;
    data.normals = object.surface.normals.address;
    data.tangents = object.surface.tangents.address;
    data.uvs = object.surface.uvs.address;
    data.rest = object.rest.address;
    data.scalars = object.scalars.values.address;
    if (data.uvs != 0) data.flags |= object_has_uvs;
    if (data.tangents != 0) data.flags |= object_has_tangents;
    if (data.rest != 0) data.flags |= object_has_rest;
    if (data.scalars != 0) data.flags |= object_has_scalars;
    data.scale_kind = static_cast<std::uint32_t>(object.scalars.scale);
    for (std::size_t i = 0; i < 4; ++i) data.transform[i] = vec4(as_glm(object.transform[i]), 0);
    const float range = object.scalars.most - object.scalars.least;
    data.scale = vec4(object.uv_meters[0], object.uv_meters[1], object.scalars.least, range > 0 ? 1 / range : 0.0f);
    return data;
}

ObjectData ground_data(const Ground& ground, const Camera& camera) {
    ObjectData data{};
    data.flags = object_has_uvs | object_has_tangents | object_has_rest;
    const vec3 normal = normalize(as_glm(ground.normal)), target = as_glm(camera.target);
    const vec3 along = normalize(cross(std::abs(normal.z) < 0.9f ? vec3(0, 0, 1) : vec3(1, 0, 0), normal));
    data.transform[0] = vec4(along, 0);
    data.transform[1] = vec4(cross(normal, along), 0);
    data.transform[2] = vec4(normal, 0);
    data.transform[3] = vec4(target + normal * (ground.offset - dot(normal, target)), 0);
    data.scale = vec4(1, 1, 0, 0);
    return data;
}

vec2 jitter_of(std::uint32_t number, std::uint32_t count) {
    if (count <= 1) return {0, 0};
    // R2 sequence (Roberts 2018): multiples of powers of the plastic number.
    const auto part = [&](double step) {
        const double at = 0.5 + step * (number + 1.0);
        return static_cast<float>(at - std::floor(at) - 0.5);
    };
    return {part(0.7548776662466927), part(0.5698402909980532)};
}

}  // namespace weft::render
