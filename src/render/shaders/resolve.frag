#version 460
// Resolves the samples of a pixel to one color: composites sheer cloth over the rest, tone-maps each sample, and then
// takes the mean, so that edges to very bright areas stay smooth.
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
        bool as_it_is = one.a > 1.5;  // a color of a scale (lit.frag)
        vec3 shown = as_it_is ? one.rgb : tone_map(one.rgb);
        float alpha = min(one.a, 1.0);
#ifdef WEFT_SHEER
        vec4 sum = texelFetch(sheer_sum, pixel, i);
        float covered = 1.0 - exp(-texelFetch(sheer_depth, pixel, i).r);
        if (sum.a > 0.0) {
            vec3 over = sum.rgb / sum.a;
            shown = as_it_is ? mix(shown, tone_map(over), covered) : tone_map(mix(one.rgb, over, covered));
            alpha = mix(alpha, 1.0, covered);
        }
#endif
        all += vec4(shown, alpha);
    }
    color = all * push.numbers.x / float(samples);  // numbers.x: weight of this pass among all passes of the image
}
