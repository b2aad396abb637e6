#version 450
// Counts how often each digit occurs in each tile.
#extension GL_GOOGLE_include_directive : require
#include "vulkan/shaders/primitives/digits.glsl"

#define WEFT_COPIES 8u  // neighbors often have the same digit; copies avoid contention for its counter

shared uint counters[WEFT_DIGITS * WEFT_COPIES];

void main()
{
    uint group = workgroup(), begin = group * WEFT_TILE, me = gl_LocalInvocationID.x;
    if (begin >= args.count) return;
    for (uint i = me; i < WEFT_DIGITS * WEFT_COPIES; i += WEFT_GROUP) counters[i] = 0u;
    barrier();
    for (uint i = me; i < WEFT_TILE && begin + i < args.count; i += WEFT_GROUP)
        atomicAdd(counters[digit_at(begin + i) * WEFT_COPIES + me % WEFT_COPIES], 1u);
    barrier();
    if (me >= WEFT_DIGITS) return;
    uint sum = 0u;
    for (uint k = 0u; k < WEFT_COPIES; ++k) sum += counters[me * WEFT_COPIES + k];
    args.places.at[me * args.tiles + group] = sum;
}
