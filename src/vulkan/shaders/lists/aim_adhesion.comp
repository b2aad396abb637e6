#version 450
// Moves the targets of sticking particles with the colliders, once per substep.
#extension GL_GOOGLE_include_directive : require
#include "vulkan/shaders/lists/list.glsl"

void main()
{
    uint row = invocation();
    if (row >= first_row(list.items)) return;
    vec4 on_collider = list.targets.at[row];
    // All cloths have the same colliders.
    ColliderIn collider = list.members.at[0].colliders.at.colliders.at[floatBitsToUint(on_collider.w)];
    PoseIn pose = pose_after(list.members.at[0].colliders, collider, list.substep + 1u);
    vec3 target = rotate(pose.x.xyz, pose.y.xyz, pose.z.xyz, on_collider.xyz) + pose.position.xyz;
    list.fields.at[row] = target.x;
    list.fields.at[list.stride + row] = target.y;
    list.fields.at[2u * list.stride + row] = target.z;
}
