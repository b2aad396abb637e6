#version 460
#include "render/shaders/common.glsl"

layout(location = 0) in vec4 color;
layout(location = 1) noperspective in float across;
layout(location = 2) in float half_width;
layout(location = 0) out vec4 result;

void main() {
    float covered = clamp(half_width + 0.5 - abs(across), 0.0, 1.0) * min(1.0, 2.0 * half_width);
    result = vec4(srgb_decoded(color.rgb), color.a * covered);
}
