// Common start of these shaders. A workgroup works on a tile of consecutive elements. The shaders use no subgroup
// operations, and no workgroup waits for another.
#ifndef WEFT_TILES_GLSL
#define WEFT_TILES_GLSL

#define WEFT_ACCESS
#include "vulkan/primitives/args.data.h"

layout(local_size_x = WEFT_GROUP) in;

// A dispatch of more workgroups than fit along x continues along y.
uint workgroup() { return gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x; }
uint invocation() { return workgroup() * WEFT_GROUP + gl_LocalInvocationID.x; }

// Reads with a stride of 16 would all use the same two banks of shared memory. One gap per 32 elements spreads them.
#define WEFT_PADDED_TILE 2112
uint padded(uint i) { return i + (i >> 5u); }

shared uint partial[2u * WEFT_GROUP];

// Sum of `mine` over the invocations before this one, and over all (Hillis and Steele 1986). Call once per shader.
uint sum_before(uint mine, out uint all)
{
    uint me = gl_LocalInvocationID.x;
    partial[me] = mine;
    barrier();
    uint at = 0u;
    for (uint reach = 1u; reach < WEFT_GROUP; reach *= 2u) {
        uint sum = partial[at + me];
        if (me >= reach) sum += partial[at + me - reach];
        at ^= WEFT_GROUP;  // the other half, which no invocation reads now
        partial[at + me] = sum;
        barrier();
    }
    all = partial[at + WEFT_GROUP - 1u];
    return me > 0u ? partial[at + me - 1u] : 0u;
}

#endif
