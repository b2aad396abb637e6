#version 450
// Computes the number of workgroups for this frame's list, and reports a full list. Runs as one workgroup.
#extension GL_GOOGLE_include_directive : require
#include "vulkan/shaders/lists/list.glsl"

void main()
{
    uint me = gl_LocalInvocationID.x, wanted = list.places.at[list.items];
    if (me == 0u) {
        uint groups = (min(wanted, list.capacity) + list.group - 1u) / list.group;
        uint wide = max(min(groups, list.widest), 1u);
        list.head.at[0] = wide;
        list.head.at[1] = (groups + wide - 1u) / wide;
        list.head.at[2] = 1u;
        list.head.at[WEFT_LIST_WANTED] = wanted;
    }
    if (wanted <= list.capacity) return;
    for (uint m = me; m < list.member_count; m += gl_WorkGroupSize.x)
        atomicOr(list.members.at[m].report.at[0], WEFT_REPORT_LIST_FULL);
}
