#version 460
#include "render/shaders/common.glsl"
#include "render/shading/color_scale.h"

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 tangent;
layout(location = 3) in vec2 uv;
layout(location = 4) in vec3 rest;
layout(location = 5) in float scalar;
layout(location = 0) out vec4 color;
#include "render/shaders/surface.glsl"

// 0: both sides, by gl_FrontFacing; 1: only front sides are drawn; 2: only back sides.
layout(constant_id = 0) const uint sides = 0u;

// Color of the scale, slightly shaded to show the shape. Independent of light and exposure.
vec3 scalar_color(Place place) {
    float t = clamp((scalar - whole(object.scale).z) * whole(object.scale).w, 0.0, 1.0);
    float shade = 0.72 + 0.28 * dot(place.normal, place.to_eye);
    return srgb_decoded(color_scale(t, int(object.scale_kind))) * shade;
}

void main() {
    bool front = sides == 0u ? gl_FrontFacing : sides == 1u;
    Place place = find_place(normal, tangent, uv, rest, front, gl_FragCoord.xy);
    if ((object.flags & object_has_scalars) != 0u) {
        color = vec4(scalar_color(place), draft ? 1.0 : 2.0);  // alpha 2: resolve.frag does not tone-map it
    } else {
        // Sheer cloth of a draft is blended over what was drawn before.
        float alpha = draft ? coverage_at(abs(dot(place.normal, place.to_eye))) : 1.0;
        color = written(light_of(place), alpha);
    }
}
