#version 450
// Writes the edges, the hinges and the list of edges with three triangles or more, in the format of mesh/edges.h.
#extension GL_GOOGLE_include_directive : require
#include "vulkan/shaders/primitives/tiles.glsl"
#include "vulkan/topology/args.data.h"

layout(push_constant) uniform Push { EdgeArgs args; };

uvec3 triangle_at(uint t)
{
    return uvec3(args.triangles.at[3u * t], args.triangles.at[3u * t + 1u], args.triangles.at[3u * t + 2u]);
}

bool winds(uvec3 t, uint from, uint to)
{
    return (t.x == from && t.y == to) || (t.y == from && t.z == to) || (t.z == from && t.x == to);
}

void write_hinge(uint hinge, uint edge, uint a, uint b, uint triangle0, uint triangle1)
{
    uvec3 t0 = triangle_at(triangle0), t1 = triangle_at(triangle1);
    bool first_is_left = winds(t0, a, b);
    // The count does not depend on the order.
    if (first_is_left == winds(t1, a, b)) atomicAdd(args.to_inconsistent.at[0], 1u);
    uint opposite0 = t0.x ^ t0.y ^ t0.z ^ a ^ b, opposite1 = t1.x ^ t1.y ^ t1.z ^ a ^ b, to = 7u * hinge;
    args.to_hinges.at[to] = a;
    args.to_hinges.at[to + 1u] = b;
    args.to_hinges.at[to + 2u] = first_is_left ? opposite0 : opposite1;
    args.to_hinges.at[to + 3u] = first_is_left ? opposite1 : opposite0;
    args.to_hinges.at[to + 4u] = edge;
    args.to_hinges.at[to + 5u] = first_is_left ? triangle0 : triangle1;
    args.to_hinges.at[to + 6u] = first_is_left ? triangle1 : triangle0;
}

void main()
{
    uint i = invocation();
    if (i >= args.count) return;
    uint edge = args.heads.at[i], hinge = args.hinges.at[i], crowded = args.crowded.at[i];
    if (args.heads.at[i + 1u] == edge) return;  // not the first side of an edge
    bool is_hinge = args.hinges.at[i + 1u] != hinge, is_crowded = args.crowded.at[i + 1u] != crowded;

    uint a = args.high.at[i], b = args.low.at[i], triangle0 = args.value.at[i], triangle1 = 0xffffffffu;
    if (is_hinge || is_crowded) triangle1 = args.value.at[i + 1u];
    args.to_edges.at[4u * edge] = a;
    args.to_edges.at[4u * edge + 1u] = b;
    args.to_edges.at[4u * edge + 2u] = triangle0;
    args.to_edges.at[4u * edge + 3u] = triangle1;
    if (is_hinge) write_hinge(hinge, edge, a, b, triangle0, triangle1);
    if (is_crowded) args.to_crowded.at[crowded] = edge;
}
