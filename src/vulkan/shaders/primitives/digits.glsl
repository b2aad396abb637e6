// Keys and their digits.
#ifndef WEFT_DIGITS_GLSL
#define WEFT_DIGITS_GLSL

#include "vulkan/shaders/primitives/tiles.glsl"

layout(push_constant) uniform Push { SortArgs args; };

// Both words of a key form one number. A digit may have its lower bits in the low word and the others in the high word.
uint digit_at(uint i)
{
    uint digit = 0u;
    if (args.shift < args.bits) {
        uint left = args.bits - args.shift;  // of the low word
        digit = args.low.at[i] >> args.shift;
        if (left < WEFT_DIGIT_BITS) digit |= args.high.at[i] << left;
    } else {
        digit = args.high.at[i] >> (args.shift - args.bits);
    }
    return digit & (WEFT_DIGITS - 1u);
}

#endif
