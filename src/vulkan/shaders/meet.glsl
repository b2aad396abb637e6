// Where the invocations of a workgroup wait for one another.
#ifndef WEFT_MEET_GLSL
#define WEFT_MEET_GLSL
#extension GL_KHR_memory_scope_semantics : require

// All that came before is done and seen by the whole workgroup. Without the Vulkan memory model every access is one that
// others may see, and such a barrier makes what was written available and visible.
void meet()
{
    controlBarrier(gl_ScopeWorkgroup, gl_ScopeWorkgroup, gl_StorageSemanticsBuffer | gl_StorageSemanticsShared,
                   gl_SemanticsAcquireRelease);
}

#endif
