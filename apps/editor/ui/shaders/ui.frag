#version 460

layout(location = 0) in vec2 uv;
layout(location = 1) in vec4 color;
layout(location = 0) out vec4 result;
layout(set = 0, binding = 0) uniform sampler2D image;
layout(constant_id = 0) const uint coverage = 0u;  // 1: the image has one channel, the alpha of white
layout(constant_id = 1) const uint decode = 0u;    // 1: the target encodes sRGB by itself

vec3 srgb_decoded(vec3 c) { return mix(c / 12.92, pow((c + 0.055) / 1.055, vec3(2.4)), greaterThan(c, vec3(0.04045))); }

void main() {
    const vec4 texel = texture(image, uv);
    result = color * (coverage != 0u ? vec4(1.0, 1.0, 1.0, texel.r) : texel);
    if (decode != 0u) result.rgb = srgb_decoded(result.rgb);
}
