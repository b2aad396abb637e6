// A dispatch of one pass of several cloths: each has a command, and its workgroups follow those of the cloth before it.
#ifndef WEFT_DISPATCH_GLSL
#define WEFT_DISPATCH_GLSL

struct MemberIn {
    uvec2 command;
    uint first_group;
    uint unused;
};
layout(buffer_reference, std430, buffer_reference_align = 8) readonly buffer MembersRef { MemberIn at[]; };

layout(push_constant) uniform Push {
    uvec2 commands;    // of one cloth its command, of several MembersRef
    uint members;
    uint groups;       // workgroups of all
    uint groups_each;  // of each; 0: they differ
    uint substep;      // substeps_before
};

// What a workgroup works on.
struct Share {
    uvec2 command;  // 0: nothing
    uint group;     // among those of the command
};

Share share_of_workgroup()
{
    // A dispatch of more workgroups than fit along one axis goes on along the next, and may have too many there.
    uint group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    substeps_before = substep;
    if (group >= groups) return Share(uvec2(0u), 0u);
    if (members == 1u) return Share(commands, group);
    MembersRef table = MembersRef(commands);
    if (groups_each > 0u) return Share(table.at[group / groups_each].command, group % groups_each);
    uint begin = 0u, end = members;  // the last one that begins here or before is in between
    while (begin + 1u < end) {
        uint middle = (begin + end) / 2u;
        if (table.at[middle].first_group <= group) begin = middle;
        else end = middle;
    }
    return Share(table.at[begin].command, group - table.at[begin].first_group);
}

// The number of an invocation among those of its command.
uint invocation_of(Share share) { return share.group * gl_WorkGroupSize.x + gl_LocalInvocationID.x; }

#endif
