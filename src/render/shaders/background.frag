#version 460
#include "render/shaders/common.glsl"

layout(location = 0) in vec2 place;
layout(location = 0) out vec4 color;
layout(set = 0, binding = 0) uniform sampler2D background_map;

void main() {
    vec4 far = frame.from_clip * vec4(place * 2.0 - 1.0, 1.0, 1.0);
    vec3 direction = normalize(far.xyz / far.w - frame.eye.xyz);
    if (draft) {
        vec3 seen = sky_at(direction);
        for (int i = 0; i < rounds(whole(frame.background).y > 0.5); ++i)
            seen = textureLod(background_map, environment_place(picture_direction(direction)), 0.0).rgb * whole(frame.environment).x;
        color = written(seen * whole(frame.light).x, 1.0);
        return;
    }
    vec3 light = whole(frame.background).y > 0.5
                     ? textureLod(background_map, environment_place(picture_direction(direction)), 0.0).rgb * whole(frame.environment).x
                     : sky_at(direction);
    color = vec4(light * whole(frame.light).x, 1.0);
}
