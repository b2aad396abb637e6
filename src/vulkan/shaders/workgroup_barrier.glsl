// Barrier for the invocations of a workgroup.
#ifndef WEFT_MEET_GLSL
#define WEFT_MEET_GLSL
#extension GL_KHR_memory_scope_semantics : require

// All earlier writes are complete and visible to the whole workgroup. Without the Vulkan memory model, every access is
// non-private, and such a barrier makes writes available and visible.
void workgroup_barrier()
{
    controlBarrier(gl_ScopeWorkgroup, gl_ScopeWorkgroup, gl_StorageSemanticsBuffer | gl_StorageSemanticsShared,
                   gl_SemanticsAcquireRelease);
}

// The same for shared memory only. Accesses to device memory may go on beyond it.
void shared_barrier()
{
    controlBarrier(gl_ScopeWorkgroup, gl_ScopeWorkgroup, gl_StorageSemanticsShared, gl_SemanticsAcquireRelease);
}

#endif
