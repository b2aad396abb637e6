#version 450
// Marks, among sorted sides, the first side of each edge, of each edge with two triangles (a hinge), and of each with
// more. A zero follows each list, so that its scan ends with the sum.
#extension GL_GOOGLE_include_directive : require
#include "vulkan/shaders/primitives/tiles.glsl"
#include "vulkan/topology/args.data.h"

layout(push_constant) uniform Push { EdgeArgs args; };

bool same(uint i, uint j) { return args.high.at[i] == args.high.at[j] && args.low.at[i] == args.low.at[j]; }

void main()
{
    uint i = invocation();
    if (i > args.count) return;
    bool head = i < args.count && (i == 0u || !same(i, i - 1u));
    bool two = head && i + 1u < args.count && same(i, i + 1u);
    bool three = two && i + 2u < args.count && same(i, i + 2u);
    args.heads.at[i] = head ? 1u : 0u;
    args.hinges.at[i] = two && !three ? 1u : 0u;
    args.crowded.at[i] = three ? 1u : 0u;
}
