#version 450
// Finds the particles that stick to colliders at the beginning of the frame. Writes the number of colliders for each
// particle (WEFT_FINDS), or a constraint for each pair.
#extension GL_GOOGLE_include_directive : require
#include "vulkan/shaders/lists/list.glsl"
#include "vulkan/shaders/thickness.glsl"

void main()
{
    uint item = invocation();
    if (item >= list.items) return;
    uint member = member_of(item), p = particle_of(member, item);
#ifdef WEFT_FINDS
    uint found = 0u;
#else
    uint row = first_row(item), end = first_row(item + 1u);
    float share = row < end ? 1.0 / float(end - row) : 0.0;
    if (row == end) return;
#endif
    vec4 x = list.position.at[p];
    uint colliders = list.members.at[member].frame.at.colliders;
    float half_thickness = half_thickness_at(list.members.at[member].frame, p - list.members.at[member].base);
    for (uint c = 0u; c < colliders; ++c) {
        ColliderIn collider = list.members.at[member].colliders.at.colliders.at[c];
        if ((collider.flags & WEFT_COLLIDER_STICKS) == 0u || !shape_acts(collider, list.members.at[member].frame)) continue;
        PoseIn pose = pose_after(list.members.at[member].colliders, collider, 0u);
        vec3 local = unrotate(pose.x.xyz, pose.y.xyz, pose.z.xyz, x.xyz - pose.position.xyz);
        vec3 normal;
        float gap = distance_to(collider, local, normal);
        if (!adheres(gap - half_thickness, collider.adhesion_distance, x.w)) continue;
#ifdef WEFT_FINDS
        ++found;
#else
        if (row == end) return;  // the list is full
        list.particles.at[row] = p;
        list.fields.at[3u * list.stride + row] = collider.adhesion_compliance;
        list.share.at[row] = share;
        list.targets.at[row] = vec4(local, uintBitsToFloat(c));
        ++row;
#endif
    }
#ifdef WEFT_FINDS
    list.places.at[item + 1u] = found;
#endif
}
