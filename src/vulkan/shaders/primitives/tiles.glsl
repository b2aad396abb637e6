// What these shaders begin with: a workgroup works on a tile of elements that follow one another. Nothing here knows
// about subgroups, and no workgroup waits for another.
#ifndef WEFT_TILES_GLSL
#define WEFT_TILES_GLSL

#define WEFT_ACCESS
#include "vulkan/primitives/args.data.h"

layout(local_size_x = WEFT_GROUP) in;

// A dispatch of more workgroups than fit along one axis goes on along the next.
uint workgroup() { return gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x; }
uint invocation() { return workgroup() * WEFT_GROUP + gl_LocalInvocationID.x; }

// Invocations that read 16 elements apart would all meet in two banks of shared memory; one gap in 32 spreads them.
#define WEFT_PADDED_TILE 2112
uint padded(uint i) { return i + (i >> 5u); }

shared uint partial[2u * WEFT_GROUP];

// The sum of what the invocations before this one bring, and of all (Hillis and Steele 1986). Once in a shader.
uint sum_before(uint mine, out uint all)
{
    uint me = gl_LocalInvocationID.x;
    partial[me] = mine;
    barrier();
    uint at = 0u;
    for (uint reach = 1u; reach < WEFT_GROUP; reach *= 2u) {
        uint sum = partial[at + me];
        if (me >= reach) sum += partial[at + me - reach];
        at ^= WEFT_GROUP;  // the other half: nobody reads it now
        partial[at + me] = sum;
        barrier();
    }
    all = partial[at + WEFT_GROUP - 1u];
    return me > 0u ? partial[at + me - 1u] : 0u;
}

#endif
