#version 460
#include "render/shaders/common.glsl"
#define object push.object.data
#include "render/shading/color_scale.h"

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 tangent;
layout(location = 3) in vec2 uv;
layout(location = 4) in vec3 rest;
layout(location = 5) in float scalar;
layout(location = 0) out vec4 color;
#include "render/shaders/surface.glsl"

// 0: both sides at once, by which side is seen; 1: all that is drawn are fronts; 2: all are backs.
layout(constant_id = 0) const uint sides = 0u;

// As colors of the scale, shaded a little so that the shape is seen. Neither light nor exposure changes them.
vec3 scalar_color(Place place) {
    float t = clamp((scalar - whole(object.scale).z) * whole(object.scale).w, 0.0, 1.0);
    float shade = 0.72 + 0.28 * dot(place.normal, place.to_eye);
    return srgb_decoded(color_scale(t, int(object.scale_kind))) * shade;
}

void main() {
    bool front = sides == 0u ? gl_FrontFacing : sides == 1u;
    Place place = find_place(normal, tangent, uv, rest, front, gl_FragCoord.xy);
    if ((object.flags & object_has_scalars) != 0u) {
        color = vec4(scalar_color(place), 2.0);  // an alpha by which resolve.frag leaves it as it is
    } else {
        color = vec4(light_of(place), 1.0);
    }
}
