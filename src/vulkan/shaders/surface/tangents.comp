#version 450
// Tangents: each vertex adds up its triangles in ascending order, so that the result is deterministic.
#extension GL_GOOGLE_include_directive : require
#include "vulkan/shaders/common.glsl"
#include "vulkan/surface/args.data.h"

layout(push_constant) uniform Push { TangentArgs args; };

TangentFrame tangents_of(uint t)
{
    uint a = args.triangles.at[3u * t], b = args.triangles.at[3u * t + 1u], c = args.triangles.at[3u * t + 2u];
    float u = args.uvs.at[2u * a], v = args.uvs.at[2u * a + 1u];
    return face_tangents(args.position.at[a].xyz, args.position.at[b].xyz, args.position.at[c].xyz,
                         args.uvs.at[2u * b] - u, args.uvs.at[2u * b + 1u] - v,
                         args.uvs.at[2u * c] - u, args.uvs.at[2u * c + 1u] - v);
}

void main()
{
    uint v = invocation();
    if (v >= args.count) return;
    TangentFrame sum = TangentFrame(vec3(0.0), vec3(0.0));
    uint end = args.offsets.at[v + 1u];
    for (uint k = args.offsets.at[v]; k < end; ++k) {
        TangentFrame face = tangents_of(args.items.at[k]);
        sum.tangent = sum.tangent + face.tangent;
        sum.bitangent = sum.bitangent + face.bitangent;
    }
    float handedness;
    vec3 t = unit_tangent(sum, args.normal.at[v].xyz, handedness);
    args.to_tangent.at[v] = vec4(t, handedness);
}
