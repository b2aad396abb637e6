#version 450
// Prefix sums of each tile, plus the sums of the tiles before.
#extension GL_GOOGLE_include_directive : require
#include "vulkan/shaders/primitives/tiles.glsl"

layout(push_constant) uniform Push { ScanArgs args; };

shared uint tile[WEFT_PADDED_TILE];

void main()
{
    uint group = workgroup(), begin = group * WEFT_TILE, me = gl_LocalInvocationID.x;
    if (begin >= args.count) return;
    for (uint i = me; i < WEFT_TILE; i += WEFT_GROUP)
        tile[padded(i)] = begin + i < args.count ? args.source.at[begin + i] : 0u;
    barrier();

    // Each invocation scans consecutive elements.
    uint sum = 0u;
    for (uint k = 0u; k < WEFT_EACH; ++k) sum += tile[padded(me * WEFT_EACH + k)];
    uint all;
    uint before = sum_before(sum, all);
    if (uvec2(args.sums) != uvec2(0u)) before += args.sums.at[group];
    for (uint k = 0u; k < WEFT_EACH; ++k) {
        uint at = padded(me * WEFT_EACH + k), after = before + tile[at];
        tile[at] = args.inclusive != 0u ? after : before;
        before = after;
    }
    barrier();

    for (uint i = me; i < WEFT_TILE && begin + i < args.count; i += WEFT_GROUP)
        args.result.at[begin + i] = tile[padded(i)];
}
