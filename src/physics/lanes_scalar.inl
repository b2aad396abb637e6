// The common subset on one lane. Included inside a namespace that has defined `real` as float or double: the fallback
// of the CPU backend, the reference in tests, and every place that needs one evaluation of a kernel.

using mask = bool;
inline constexpr int lane_count = 1;

WEFT_FN real sqrt(real x) { return std::sqrt(x); }
WEFT_FN real abs(real x) { return std::fabs(x); }
WEFT_FN real floor(real x) { return std::floor(x); }
// Like the x86 instructions, return the second operand unless the comparison is true, so that all lane widths agree to
// the bit.
WEFT_FN real min(real a, real b) { return a < b ? a : b; }
WEFT_FN real max(real a, real b) { return a > b ? a : b; }
WEFT_FN real inversesqrt(real x) { return real(1) / sqrt(x); }
WEFT_FN real select(mask m, real yes, real no) { return m ? yes : no; }
WEFT_FN real least(real x) { return x; }
WEFT_FN real most(real x) { return x; }
WEFT_FN bool any(mask m) { return m; }
WEFT_FN std::uint32_t bits_of(mask m) { return m ? 1u : 0u; }
WEFT_FN mask mask_of(std::uint32_t bits) { return (bits & 1u) != 0; }
WEFT_FN mask same_index(const std::uint32_t* a, const std::uint32_t* b) { return *a == *b; }
WEFT_FN void compress(const std::uint32_t* from, mask, std::uint32_t* to) { *to = *from; }
WEFT_FN void compress(real from, mask, real* to) { *to = from; }
WEFT_FN void fill(std::uint32_t number, std::uint32_t* to) { *to = number; }

#include "physics/lanes_vec3.inl"

WEFT_FN real load(const real* p) { return *p; }
WEFT_FN void store(real v, real* p) { *p = v; }
WEFT_FN real gather(const real* base, const std::uint32_t* index) { return base[*index]; }

// Blocks of four: x, y, z and one more number.
WEFT_FN vec3 load_blocks(const real* p, real& fourth) {
    fourth = p[3];
    return vec3(p[0], p[1], p[2]);
}
WEFT_FN void store_blocks(vec3 v, real fourth, real* p) {
    p[0] = v.x;
    p[1] = v.y;
    p[2] = v.z;
    p[3] = fourth;
}
WEFT_FN vec3 load_blocks_unordered(const real* p, real& fourth) { return load_blocks(p, fourth); }
WEFT_FN void store_blocks_unordered(vec3 v, real fourth, real* p) { store_blocks(v, fourth, p); }
template <class Index>
WEFT_FN vec3 gather_blocks(const real* base, const Index* index, real& fourth) {
    return load_blocks(base + 4 * std::size_t{*index}, fourth);
}
WEFT_FN void scatter_blocks(vec3 v, real fourth, real* base, const std::uint32_t* index) {
    store_blocks(v, fourth, base + 4 * std::size_t{*index});
}
// Blocks of integers as numbers, and back.
template <class Index>
WEFT_FN vec3 gather_integer_blocks(const std::int32_t* base, const Index* index, real& fourth) {
    const std::int32_t* block = base + 4 * std::size_t{*index};
    fourth = static_cast<real>(block[3]);
    return vec3(static_cast<real>(block[0]), static_cast<real>(block[1]), static_cast<real>(block[2]));
}
WEFT_FN void store_integer_blocks(vec3 v, real fourth, std::int32_t* p) {
    p[0] = static_cast<std::int32_t>(v.x);
    p[1] = static_cast<std::int32_t>(v.y);
    p[2] = static_cast<std::int32_t>(v.z);
    p[3] = static_cast<std::int32_t>(fourth);
}

// Data of a shape. A block or a word of its own for each lane is numbered by a whole number from 0 to 2^24.
struct Shorts {
    real s0, s1, s2, s3, s4, s5, s6, s7;
};
// Integers of one word or block, the same for all lanes.
WEFT_FN int integer_of(ShapeBlocks d, int word) {
    std::int32_t number;
    __builtin_memcpy(&number, d.words + word, sizeof number);
    return number;
}
WEFT_FN vec3 block_of(ShapeBlocks d, int block, real& fourth) {
    const float* at = d.words + 4 * block;
    fourth = static_cast<real>(at[3]);
    return vec3(static_cast<real>(at[0]), static_cast<real>(at[1]), static_cast<real>(at[2]));
}
// The float of each lane's word.
WEFT_FN real number_of(ShapeBlocks d, real word) { return static_cast<real>(d.words[static_cast<std::int32_t>(word)]); }
// The eight signed 16-bit integers of each lane's block; the first one is the lower half of the first word.
WEFT_FN Shorts shorts_of(ShapeBlocks d, real block) {
    std::int16_t s[8];
    __builtin_memcpy(s, d.words + 4 * static_cast<std::int32_t>(block), sizeof s);
    const auto number = [&](int i) { return static_cast<real>(s[i]); };
    return {number(0), number(1), number(2), number(3), number(4), number(5), number(6), number(7)};
}
