#version 450
// The sum of each tile.
#extension GL_GOOGLE_include_directive : require
#include "vulkan/shaders/primitives/tiles.glsl"

layout(push_constant) uniform Push { ScanArgs args; };

void main()
{
    uint group = workgroup(), begin = group * WEFT_TILE, me = gl_LocalInvocationID.x;
    if (begin >= args.count) return;
    uint sum = 0u;
    for (uint k = 0u; k < WEFT_EACH; ++k) {
        uint i = begin + k * WEFT_GROUP + me;
        if (i < args.count) sum += args.source.at[i];
    }
    uint all;
    sum_before(sum, all);
    if (me == 0u) args.sums.at[group] = all;
}
