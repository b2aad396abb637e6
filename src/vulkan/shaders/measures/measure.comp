#version 450
// Sum and largest term of each tile, always in the same order: each invocation adds 16 terms, then a tree reduction.
// WEFT_ARGS is the type of the arguments, and WEFT_MEASURES_… selects the terms.
#extension GL_GOOGLE_include_directive : require
#include "vulkan/shaders/primitives/tiles.glsl"
#include "vulkan/measures/args.data.h"
#include "physics/stretch/stretch.data.h"

layout(push_constant) uniform Push { WEFT_ARGS args; };

#include "vulkan/shaders/measures/terms.glsl"

shared float sums[WEFT_GROUP];
shared uint sizes[WEFT_GROUP];

void main()
{
    uint tile = workgroup(), me = gl_LocalInvocationID.x;
    float sum = 0.0;
    uint size = 0u;
    for (uint k = 0u; k < WEFT_EACH; ++k) {
        uint i = tile * WEFT_TILE + k * WEFT_GROUP + me;
        if (i < args.count) {
            Term term = term_of(i);
            sum += term.value;
            size = max(size, term.size);
        }
    }
    sums[me] = sum;
    sizes[me] = size;
    for (uint reach = WEFT_GROUP / 2u; reach > 0u; reach /= 2u) {
        barrier();
        if (me < reach) {
            sums[me] = sums[me] + sums[me + reach];
            sizes[me] = max(sizes[me], sizes[me + reach]);
        }
    }
    if (me == 0u && tile * WEFT_TILE < args.count) {
        args.found.at[2u * tile] = floatBitsToUint(sums[0]);
        args.found.at[2u * tile + 1u] = sizes[0];
    }
}
