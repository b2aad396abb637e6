#version 450
// Moves drawn vertices, each of which follows a triangle of the simulated mesh.
#extension GL_GOOGLE_include_directive : require
#include "vulkan/shaders/common.glsl"
#include "vulkan/surface/args.data.h"

layout(push_constant) uniform Push { BoundArgs args; };

void main()
{
    uint v = invocation();
    if (v >= args.count) return;
    uint a = args.particles.at[3u * v], b = args.particles.at[3u * v + 1u], c = args.particles.at[3u * v + 2u];
    vec4 first = args.shape.at[2u * v], second = args.shape.at[2u * v + 1u];
    FollowFrame frame = follow_frame(args.position.at[a].xyz, args.position.at[b].xyz, args.position.at[c].xyz,
                                     args.normals.at[a].xyz, args.normals.at[b].xyz, args.normals.at[c].xyz,
                                     first.x, first.y);
    args.to_position.at[v] = vec4(frame.origin + out_of(frame, vec3(first.z, first.w, second.x)), 1.0);
    args.to_normal.at[v] = vec4(out_of(frame, second.yzw), 0.0);
}
