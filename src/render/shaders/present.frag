#version 460
// Writes to the target, with dithering of half a step against banding.
#include "render/shaders/common.glsl"

layout(location = 0) in vec2 place;
layout(location = 0) out vec4 color;
layout(set = 0, binding = 0) uniform sampler2D display;
layout(constant_id = 0) const uint encode = 0u;    // 1: the target does not encode sRGB by itself
layout(constant_id = 1) const uint straight = 0u;  // 1: colors are not multiplied by alpha

void main() {
    color = texelFetch(display, ivec2(gl_FragCoord.xy), 0);
    if (straight != 0u && color.a > 0.0) color.rgb /= color.a;
    vec3 encoded = srgb_encoded(clamp(color.rgb, 0.0, 1.0));
    encoded = clamp(encoded + (pixel_noise(gl_FragCoord.xy, 0.0) - 0.5) / 255.0 * step(1e-5, color.a), 0.0, 1.0);
    color.rgb = encode != 0u ? encoded : srgb_decoded(encoded);
}
