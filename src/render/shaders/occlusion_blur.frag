#version 460
// Removes the noise by a mean over four by four pixels of similar depth.
#include "render/shaders/common.glsl"

layout(location = 0) in vec2 place;
layout(location = 0) out vec2 left;
layout(set = 0, binding = 0) uniform sampler2D occlusion;

void main() {
    ivec2 here = ivec2(gl_FragCoord.xy), most = textureSize(occlusion, 0) - 1;
    float depth = texelFetch(occlusion, here, 0).g, sum = 0.0, weights = 0.0;
    for (int y = -2; y < 2; ++y) {
        for (int x = -2; x < 2; ++x) {
            vec2 tap = texelFetch(occlusion, clamp(here + ivec2(x, y), ivec2(0), most), 0).rg;
            float weight = max(0.0, 1.0 - 40.0 * abs(tap.g - depth) / depth) + 1e-4;
            sum += weight * tap.r;
            weights += weight;
        }
    }
    left = vec2(sum / weights, depth);
}
