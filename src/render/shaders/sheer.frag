#version 460
// Order-independent transparency for sheer cloth: weighted sums of color, and optical depth (McGuire and Bavoil 2013).
// Optical depth is a sum of logarithms instead of a product, so that both images use the same blending.
#include "render/shaders/common.glsl"

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 tangent;
layout(location = 3) in vec2 uv;
layout(location = 4) in vec3 rest;
layout(location = 5) in float scalar;
layout(location = 0) out vec4 sum;
layout(location = 1) out vec4 depth;
#include "render/shaders/surface.glsl"

layout(constant_id = 0) const uint sides = 0u;

void main() {
    bool front = sides == 0u ? gl_FrontFacing : sides == 1u;
    Place place = find_place(normal, tangent, uv, rest, front, gl_FragCoord.xy);
    float covered = clamp(coverage_at(abs(dot(place.normal, place.to_eye))), 0.0, 0.999);
    float weight = covered * exp(-4.0 * length(frame.eye.xyz - position) / whole(frame.target).w);
    sum = vec4(light_of(place) * weight, weight);
    depth = vec4(-log(1.0 - covered));
}
