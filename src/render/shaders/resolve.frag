#version 460
// Samples of a pixel become one color: sheer cloth over the rest, tones pressed into what a screen shows, and only then
// the mean, so that an edge to a very bright place stays smooth.
#include "render/shaders/common.glsl"

layout(location = 0) in vec2 place;
layout(location = 0) out vec4 color;
layout(constant_id = 0) const uint samples = 4u;
#ifdef WEFT_MULTISAMPLED
#define WEFT_PICTURE sampler2DMS
#else
#define WEFT_PICTURE sampler2D
#endif
layout(set = 0, binding = 0) uniform WEFT_PICTURE lit;
#ifdef WEFT_SHEER
layout(set = 0, binding = 1) uniform WEFT_PICTURE sheer_sum;
layout(set = 0, binding = 2) uniform WEFT_PICTURE sheer_depth;
#endif

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 all = vec4(0.0);
    for (int i = 0; i < int(samples); ++i) {
        vec4 one = texelFetch(lit, pixel, i);
#ifdef WEFT_SHEER
        vec4 sum = texelFetch(sheer_sum, pixel, i);
        float covered = 1.0 - exp(-texelFetch(sheer_depth, pixel, i).r);
        if (sum.a > 0.0) one = mix(one, vec4(sum.rgb / sum.a, 1.0), covered);
#endif
        all += vec4(tone_map(one.rgb), one.a);
    }
    color = all * push.numbers.x / float(samples);  // a share of all passes over this picture
}
