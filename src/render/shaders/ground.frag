#version 460
#include "render/shaders/common.glsl"

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 tangent;
layout(location = 3) in vec2 uv;
layout(location = 4) in vec3 rest;
layout(location = 5) in float scalar;
layout(location = 0) out vec4 color;
#include "render/shaders/surface.glsl"

void main() {
    Place place = find_place(normal, tangent, uv, rest, gl_FrontFacing, gl_FragCoord.xy);
    float fading = smoothstep(whole(frame.background).z, whole(frame.background).w, length(position - frame.target.xyz));
    if (draft) {
        vec3 far = sky_at(-place.to_eye);
        for (int i = 0; i < rounds(whole(frame.background).y > 0.5); ++i)
            far = textureLod(background_map, environment_place(picture_direction(-place.to_eye)), 0.0).rgb * whole(frame.environment).x;
        color = written(mix(light_of(place), far * whole(frame.light).x, fading), 1.0);
        return;
    }
    vec3 behind = whole(frame.background).y > 0.5
                      ? textureLod(background_map, environment_place(picture_direction(-place.to_eye)), 0.0).rgb *
                            whole(frame.environment).x
                      : sky_at(-place.to_eye);
    float occlusion = occlusion_at(gl_FragCoord.xy, position);
    // For a ground that shows only its shadows: the share of light that they remove.
    float sun = dot(frame.sun_color.rgb, vec3(1.0)) / pi * max(0.0, dot(place.normal, frame.sun.xyz));
    float around = dot(around_at(place.normal), vec3(1.0));
    vec3 seen = mix(light_of(place), behind * whole(frame.light).x, fading);
    float reached = sun_reaching(position, place.normal, gl_FragCoord.xy);
    float shadow = 1.0 - (sun * reached + around * occlusion) / max(sun + around, 1e-6);
    color = whole(frame.background).x > 0.5 ? vec4(0.0, 0.0, 0.0, shadow * (1.0 - fading)) : vec4(seen, 1.0);
}
