// Sums of 64 bits in two words.
#ifndef WEFT_SUM_WORDS_GLSL
#define WEFT_SUM_WORDS_GLSL

// The number as 64 bits, low word first. It must be less than 2^63. The two words represent the float exactly.
uvec2 words_of(float quanta)
{
    float size = abs(quanta);
    float high = floor(size * (1.0 / 4294967296.0));
    uvec2 words = uvec2(uint(size - high * 4294967296.0), uint(high));
    if (quanta < 0.0) {
        words = ~words;
        words.x += 1u;
        if (words.x == 0u) words.y += 1u;
    }
    return words;
}

// The number of 64 bits times 2^-44, rounded to the nearest float, ties to even.
float float_of_quanta(uvec2 words)
{
    bool negative = (words.y & 0x80000000u) != 0u;
    if (negative) {
        words = ~words;
        words.x += 1u;
        if (words.x == 0u) words.y += 1u;
    }
    if (words == uvec2(0u)) return 0.0;
    int top = words.y != 0u ? 32 + findMSB(words.y) : findMSB(words.x);
    int shift = max(top - 23, 0);  // bits that a float has no room for
    uint kept = words.x, dropped = 0u, half_bit = 0u;
    if (shift >= 32) {
        kept = words.y >> (shift - 32);
        uint rest = shift > 32 ? words.y & ((1u << (shift - 32)) - 1u) : 0u;
        // The bit below the last kept one, and whether any lower bit is set.
        half_bit = shift > 32 ? (rest >> (shift - 33)) & 1u : words.x >> 31;
        uint lower = shift > 32 ? (rest & ((1u << (shift - 33)) - 1u)) | words.x : words.x & 0x7fffffffu;
        dropped = lower != 0u ? 1u : 0u;
    } else if (shift > 0) {
        kept = (words.x >> shift) | (words.y << (32 - shift));
        half_bit = (words.x >> (shift - 1)) & 1u;
        dropped = (words.x & ((1u << (shift - 1)) - 1u)) != 0u ? 1u : 0u;
    }
    kept += half_bit & (dropped | (kept & 1u));
    // Both factors are powers of two in range, and `kept` has at most 24 bits, or is 2^24.
    float scaled = float(kept) * uintBitsToFloat(uint(127 + shift - 44) << 23);
    return negative ? -scaled : scaled;
}

#endif
