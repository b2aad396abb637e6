#version 460
#extension GL_GOOGLE_include_directive : require
#include "output.glsl"

layout(location = 0) in vec2 uv;
layout(location = 1) in vec4 color;
layout(location = 0) out vec4 result;
layout(set = 0, binding = 0) uniform sampler2D image;
layout(constant_id = 1) const uint coverage = 0u;  // 1: the image has one channel, the alpha of white

void main() {
    const vec4 texel = texture(image, uv);
    result = for_target(color * (coverage != 0u ? vec4(1.0, 1.0, 1.0, texel.r) : texel));
}
