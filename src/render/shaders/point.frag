#version 460
#include "render/shaders/common.glsl"

layout(location = 0) in vec4 color;
layout(location = 1) noperspective in vec2 place;
layout(location = 2) in float radius;
layout(location = 0) out vec4 result;

void main() {
    float inside = clamp(radius + 0.5 - length(place), 0.0, 1.0);
    float rim = clamp(radius - 0.8 - length(place), 0.0, 1.0);  // dark rim, visible on any color
    result = vec4(srgb_decoded(color.rgb) * mix(0.15, 1.0, rim), color.a * inside);
}
