#version 450
// Sorts each tile by a digit and carries it to where the digits of all tiles belong. Equal digits keep their order.
#extension GL_GOOGLE_include_directive : require
#include "vulkan/shaders/primitives/digits.glsl"

// Counters of 16 bits, two in a word: [digit % 16 · group + invocation], digits from 16 on in the upper halves.
#define WEFT_HALF (WEFT_DIGITS / 2u)

shared uint pool[WEFT_PADDED_TILE];  // the counters, then which element goes to which place in the sorted tile
shared uint first[WEFT_DIGITS];      // where a digit's elements go, less its place in the sorted tile

uint counter_of(uint digit, uint invocation) { return padded(digit % WEFT_HALF * WEFT_GROUP + invocation); }
uint upper_of(uint digit) { return digit / WEFT_HALF * 16u; }

void main()
{
    uint group = workgroup(), begin = group * WEFT_TILE, me = gl_LocalInvocationID.x;
    if (begin >= args.count) return;
    uint count = min(args.count - begin, WEFT_TILE);

    // Each invocation counts the digits of elements that follow one another: how many of the same came before.
    for (uint digit = 0u; digit < WEFT_HALF; ++digit) pool[counter_of(digit, me)] = 0u;
    uint ranks[WEFT_EACH], digits[WEFT_EACH];
    for (uint k = 0u; k < WEFT_EACH; ++k) {
        uint i = me * WEFT_EACH + k;
        if (i >= count) break;
        uint digit = digit_at(begin + i), at = counter_of(digit, me), counted = pool[at];
        digits[k] = digit;
        ranks[k] = counted >> upper_of(digit) & 0xffffu;
        pool[at] = counted + (1u << upper_of(digit));
    }
    barrier();

    // All counters of a digit after those of the digits before; in each digit, the invocations in order. A tile's
    // elements fit into 16 bits, so that both halves are summed at once, and the upper ones begin with all lower.
    uint sum = 0u;
    for (uint k = 0u; k < WEFT_EACH; ++k) sum += pool[padded(me * WEFT_EACH + k)];
    uint all;
    uint before = sum_before(sum, all);
    before += all << 16;
    for (uint k = 0u; k < WEFT_EACH; ++k) {
        uint at = padded(me * WEFT_EACH + k), counted = pool[at];
        pool[at] = before;
        before += counted;
    }
    barrier();

    if (me < WEFT_DIGITS)
        first[me] = args.places.at[me * args.tiles + group] - (pool[counter_of(me, 0u)] >> upper_of(me) & 0xffffu);
    for (uint k = 0u; k < WEFT_EACH; ++k) {
        if (me * WEFT_EACH + k >= count) break;
        ranks[k] += pool[counter_of(digits[k], me)] >> upper_of(digits[k]) & 0xffffu;
    }
    barrier();
    for (uint k = 0u; k < WEFT_EACH; ++k) {
        uint i = me * WEFT_EACH + k;
        if (i >= count) break;
        pool[ranks[k]] = i;
    }
    barrier();

    // In sorted order: neighbors write side by side.
    for (uint place = me; place < count; place += WEFT_GROUP) {
        uint i = begin + pool[place], to = first[digit_at(i)] + place;
        args.to_high.at[to] = args.high.at[i];
        args.to_low.at[to] = args.low.at[i];
        args.to_value.at[to] = args.value.at[i];
    }
}
