#version 450
// Sorts each tile by a digit and writes it to its place in the sorted array. Equal digits keep their order.
#extension GL_GOOGLE_include_directive : require
#include "vulkan/shaders/primitives/digits.glsl"

// Counters of 16 bits, two in a word: [digit % 16 · group + invocation], digits from 16 on in the upper halves.
#define WEFT_HALF (WEFT_DIGITS / 2u)

shared uint pool[WEFT_PADDED_TILE];  // the counters, then the element at each place of the sorted tile
shared uint first[WEFT_DIGITS];      // destination of a digit's elements minus their place in the sorted tile

uint counter_of(uint digit, uint invocation) { return padded(digit % WEFT_HALF * WEFT_GROUP + invocation); }
uint upper_of(uint digit) { return digit / WEFT_HALF * 16u; }

void main()
{
    uint group = workgroup(), begin = group * WEFT_TILE, me = gl_LocalInvocationID.x;
    if (begin >= args.count) return;
    uint count = min(args.count - begin, WEFT_TILE);

    // Each invocation counts the digits of consecutive elements. The rank of an element is the count before it.
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

    // Prefix sums over the counters: by digit, and for each digit by invocation. The number of elements of a tile fits
    // into 16 bits, so both halves are summed at once. The upper half starts at the total of the lower half.
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

    // Writes in sorted order, so that neighbors write to adjacent addresses.
    for (uint place = me; place < count; place += WEFT_GROUP) {
        uint i = begin + pool[place], to = first[digit_at(i)] + place;
        args.to_high.at[to] = args.high.at[i];
        args.to_low.at[to] = args.low.at[i];
        args.to_value.at[to] = args.value.at[i];
    }
}
