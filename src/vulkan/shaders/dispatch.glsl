// Finds the command that a workgroup runs: the one that the dispatch pushes, or, with WEFT_MANY, one of the commands of
// several cloths. In the second case, the workgroups of a cloth follow those of the cloth before it.
#ifndef WEFT_DISPATCH_GLSL
#define WEFT_DISPATCH_GLSL

uint group_of_command = 0u;  // index of this workgroup among those of the command
uint invocation_of_command() { return group_of_command * gl_WorkGroupSize.x + gl_LocalInvocationID.x; }

// A dispatch of more workgroups than fit along x continues along y, where some may be surplus.
uint group_of_dispatch() { return gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x; }

#ifndef WEFT_MANY

layout(push_constant) uniform Push {
    WEFT_ARGS at;
    uint substep;      // substeps_before
    uint invocations;
} WEFT_PUSHED;

bool find_command()
{
    substeps_before = WEFT_PUSHED.substep;
    group_of_command = group_of_dispatch();
    return true;
}
uint invocations_of_command() { return WEFT_PUSHED.invocations; }

#else

struct MemberIn {
    uvec2 command;
    uint first_group;
    uint unused;
};
layout(buffer_reference, std430, buffer_reference_align = 8) readonly buffer MembersRef { MemberIn at[]; };

layout(push_constant) uniform Push {
    uvec2 table;       // MembersRef
    uint members;
    uint groups;       // workgroups of all
    uint groups_each;  // per cloth; 0: they differ
    uint substep;      // substeps_before
};

// Returns false if the workgroup has nothing to do.
bool find_command()
{
    substeps_before = substep;
    uint group = group_of_dispatch();
    if (group >= groups) return false;
    uint begin = 0u, end = members;  // binary search for the last one that begins at or before `group`
    if (groups_each > 0u) {
        begin = group / groups_each;
        end = begin + 1u;
    }
    while (begin + 1u < end) {
        uint middle = (begin + end) / 2u;
        if (MembersRef(table).at[middle].first_group <= group) begin = middle;
        else end = middle;
    }
    command = MembersRef(table).at[begin].command;
    group_of_command = group - MembersRef(table).at[begin].first_group;
    return true;
}
uint invocations_of_command() { return CommandRef(command).invocations; }

#endif

#endif
