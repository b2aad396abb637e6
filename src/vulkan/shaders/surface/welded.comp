#version 450
// Moves drawn vertices that coincide with particles.
#extension GL_GOOGLE_include_directive : require
#include "vulkan/shaders/common.glsl"
#include "vulkan/surface/args.data.h"

layout(push_constant) uniform Push { WeldedArgs args; };

void main()
{
    uint v = invocation();
    if (v >= args.count) return;
    uint p = args.particle.at[v];
    if (p == 0xffffffffu) return;
    args.to_position.at[v] = vec4(args.position.at[p].xyz, 1.0);
    args.to_normal.at[v] = vec4(args.normals.at[p].xyz, 0.0);
}
