#version 450
// The three sides of each triangle: its ends, the lower one first, and the triangle.
#extension GL_GOOGLE_include_directive : require
#include "vulkan/shaders/primitives/tiles.glsl"
#include "vulkan/topology/args.data.h"

layout(push_constant) uniform Push { SideArgs args; };

void main()
{
    uint t = invocation();
    if (t >= args.count) return;
    uint corners[3] = {args.triangles.at[3u * t], args.triangles.at[3u * t + 1u], args.triangles.at[3u * t + 2u]};
    for (uint k = 0u; k < 3u; ++k) {
        uint from = corners[k], to = corners[(k + 1u) % 3u];
        args.high.at[3u * t + k] = min(from, to);
        args.low.at[3u * t + k] = max(from, to);
        args.value.at[3u * t + k] = t;
    }
}
