// C++ side of the common subset, over Highway: 4, 8 or 16 lanes, one copy per instruction set. Included under
// hwy/foreach_target.h, hence the toggled guard. GLSL's side is lanes.glsl, one lane is lanes_scalar.inl.
//
// Only operations that IEEE 754 rounds exactly are used (no fused multiply-add, no approximate reciprocals), so that
// every width gives the same bits.

#if defined(WEFT_PHYSICS_LANES_H) == defined(HWY_TARGET_TOGGLE)
#ifdef WEFT_PHYSICS_LANES_H
#undef WEFT_PHYSICS_LANES_H
#else
#define WEFT_PHYSICS_LANES_H
#endif

#include "physics/kernel_language.h"
#include "physics/shape_blocks.h"

#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace weft::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<float, 16>;
using V = hn::Vec<D>;
inline constexpr int lane_count = static_cast<int>(hn::MaxLanes(D()));

struct mask {
    hn::Mask<D> m;
};

struct real {
    V v;

    real() = default;
    WEFT_FN real(V v_) : v(v_) {}
    WEFT_FN explicit real(float x) : v(hn::Set(D(), x)) {}
};

WEFT_FN real operator+(real a, real b) {
    return hn::Add(a.v, b.v);
}
WEFT_FN real operator-(real a, real b) {
    return hn::Sub(a.v, b.v);
}
WEFT_FN real operator*(real a, real b) {
    return hn::Mul(a.v, b.v);
}
WEFT_FN real operator/(real a, real b) {
    return hn::Div(a.v, b.v);
}
WEFT_FN real operator-(real a) {
    return hn::Neg(a.v);
}
WEFT_FN mask operator<(real a, real b) {
    return {hn::Lt(a.v, b.v)};
}
WEFT_FN mask operator>(real a, real b) {
    return {hn::Gt(a.v, b.v)};
}
WEFT_FN mask operator&&(mask a, mask b) {
    return {hn::And(a.m, b.m)};
}
WEFT_FN mask operator||(mask a, mask b) {
    return {hn::Or(a.m, b.m)};
}
WEFT_FN mask operator!(mask a) {
    return {hn::Not(a.m)};
}
WEFT_FN real select(mask m, real yes, real no) {
    return hn::IfThenElse(m.m, yes.v, no.v);
}
WEFT_FN bool any(mask m) {
    return !hn::AllFalse(D(), m.m);
}

// Lane i as bit i.
WEFT_FN std::uint32_t bits_of(mask m) {
    std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(D(), m.m, bytes);
    return bytes[0] | std::uint32_t{bytes[1]} << 8;
}

// The first lane_count bits as lanes.
WEFT_FN mask mask_of(std::uint32_t bits) {
    const std::uint8_t bytes[8] = {static_cast<std::uint8_t>(bits), static_cast<std::uint8_t>(bits >> 8)};
    return {hn::LoadMaskBits(D(), bytes)};
}

// Whether two lists name the same element, lane by lane.
WEFT_FN mask same_index(const std::uint32_t* a, const std::uint32_t* b) {
    const hn::Rebind<std::uint32_t, D> tag;
    return {hn::RebindMask(D(), hn::Eq(hn::LoadU(tag, a), hn::LoadU(tag, b)))};
}

// Writes the numbers of the lanes in `m`, one after another. Writes lane_count numbers in all; those after them are of
// no use.
template <class Tag>
WEFT_FN void compress(Tag tag, hn::Vec<Tag> v, mask m, hn::TFromD<Tag>* to) {
    hn::StoreU(hn::Compress(v, hn::RebindMask(tag, m.m)), tag, to);
}
WEFT_FN void compress(const std::uint32_t* from, mask m, std::uint32_t* to) {
    const hn::Rebind<std::uint32_t, D> tag;
    compress(tag, hn::LoadU(tag, from), m, to);
}
WEFT_FN void compress(real from, mask m, float* to) {
    compress(D(), from.v, m, to);
}
WEFT_FN void fill(std::uint32_t number, std::uint32_t* to) {
    const hn::Rebind<std::uint32_t, D> tag;
    hn::StoreU(hn::Set(tag, number), tag, to);
}

WEFT_FN real sqrt(real x) {
    return hn::Sqrt(x.v);
}
WEFT_FN real abs(real x) {
    return hn::Abs(x.v);
}
WEFT_FN real floor(real x) {
    return hn::Floor(x.v);
}
// Written as comparisons: in Highway the result for equal and unordered operands depends on the machine.
WEFT_FN real min(real a, real b) {
    return select(a < b, a, b);
}
WEFT_FN real max(real a, real b) {
    return select(a > b, a, b);
}
WEFT_FN real inversesqrt(real x) {
    return real(1) / sqrt(x);
}
// Over all lanes. None of them may be not a number.
WEFT_FN float least(real x) {
    return hn::GetLane(hn::MinOfLanes(D(), x.v));
}
WEFT_FN float most(real x) {
    return hn::GetLane(hn::MaxOfLanes(D(), x.v));
}

#include "physics/lanes_vec3.inl"

WEFT_FN real load(const float* p) {
    return hn::LoadU(D(), p);
}
WEFT_FN void store(real x, float* p) {
    hn::StoreU(x.v, D(), p);
}

// Blocks of four floats: x, y, z and one more number; consecutive ones here, indexed ones below.
WEFT_FN vec3 load_blocks(const float* p, real& fourth) {
    V x, y, z, w;
    hn::LoadInterleaved4(D(), p, x, y, z, w);
    fourth = w;
    return vec3(x, y, z);
}
WEFT_FN void store_blocks(vec3 v, real fourth, float* p) {
    hn::StoreInterleaved4(v.x.v, v.y.v, v.z.v, fourth.v, D(), p);
}

// The blocks of every fourth index, side by side in one register; and back.
template <class Tag, class Index>
WEFT_FN hn::Vec<Tag> load_parts(Tag tag, const float* base, const Index* index) {
    if constexpr (hn::MaxLanes(tag) == 4) {
        return hn::Load(tag, base + 4 * std::size_t{*index});
    } else {
        const hn::Half<Tag> half;
        return hn::Combine(tag, load_parts(half, base, index + hn::MaxLanes(half)), load_parts(half, base, index));
    }
}
template <class Tag>
WEFT_FN void store_parts(Tag tag, hn::Vec<Tag> v, float* base, const std::uint32_t* index) {
    if constexpr (hn::MaxLanes(tag) == 4) {
        hn::Store(v, tag, base + 4 * std::size_t{*index});
    } else {
        const hn::Half<Tag> half;
        store_parts(half, hn::LowerHalf(half, v), base, index);
        store_parts(half, hn::UpperHalf(half, v), base, index + hn::MaxLanes(half));
    }
}

// Transposes 4x4 numbers within each 128-bit block: rows of xyzw to columns, or back.
WEFT_FN void transpose_blocks(V& r0, V& r1, V& r2, V& r3) {
    const hn::Repartition<double, D> wide;
    const auto xy01 = hn::BitCast(wide, hn::InterleaveLower(D(), r0, r1));
    const auto zw01 = hn::BitCast(wide, hn::InterleaveUpper(D(), r0, r1));
    const auto xy23 = hn::BitCast(wide, hn::InterleaveLower(D(), r2, r3));
    const auto zw23 = hn::BitCast(wide, hn::InterleaveUpper(D(), r2, r3));
    r0 = hn::BitCast(D(), hn::InterleaveLower(wide, xy01, xy23));
    r1 = hn::BitCast(D(), hn::InterleaveUpper(wide, xy01, xy23));
    r2 = hn::BitCast(D(), hn::InterleaveLower(wide, zw01, zw23));
    r3 = hn::BitCast(D(), hn::InterleaveUpper(wide, zw01, zw23));
}

// Load and store consecutive blocks in the same permuted lane order, with half the shuffles. Only for loops that
// process each particle independently and use no other data per lane.
WEFT_FN vec3 load_blocks_unordered(const float* p, real& fourth) {
    V r0 = hn::LoadU(D(), p), r1 = hn::LoadU(D(), p + lane_count);
    V r2 = hn::LoadU(D(), p + 2 * lane_count), r3 = hn::LoadU(D(), p + 3 * lane_count);
    transpose_blocks(r0, r1, r2, r3);
    fourth = r3;
    return vec3(r0, r1, r2);
}
WEFT_FN void store_blocks_unordered(vec3 v, real fourth, float* p) {
    V r0 = v.x.v, r1 = v.y.v, r2 = v.z.v, r3 = fourth.v;
    transpose_blocks(r0, r1, r2, r3);
    hn::StoreU(r0, D(), p), hn::StoreU(r1, D(), p + lane_count);
    hn::StoreU(r2, D(), p + 2 * lane_count), hn::StoreU(r3, D(), p + 3 * lane_count);
}

// Half the time of the gather instructions (AVX2 on an AMD EPYC).
template <class Tag>
WEFT_FN hn::Vec<Tag> gather_parts(Tag tag, const float* base, const std::uint32_t* index) {
    if constexpr (hn::MaxLanes(tag) == 4) {
        using Raw = decltype(hn::Vec<Tag>::raw);
        return hn::Vec<Tag>{Raw{base[index[0]], base[index[1]], base[index[2]], base[index[3]]}};
    } else {
        const hn::Half<Tag> half;
        return hn::Combine(tag, gather_parts(half, base, index + hn::MaxLanes(half)), gather_parts(half, base, index));
    }
}
WEFT_FN real gather(const float* base, const std::uint32_t* index) {
    return gather_parts(D(), base, index);
}

// Loads whole 128-bit blocks and transposes them in registers: several times faster than the gather instructions.
template <class Index>
WEFT_FN vec3 gather_blocks(const float* base, const Index* index, real& fourth) {
    V r0 = load_parts(D(), base, index), r1 = load_parts(D(), base, index + 1);
    V r2 = load_parts(D(), base, index + 2), r3 = load_parts(D(), base, index + 3);
    transpose_blocks(r0, r1, r2, r3);
    fourth = r3;
    return vec3(r0, r1, r2);
}

// The same of blocks of integers.
template <class Index>
WEFT_FN vec3 gather_integer_blocks(const std::int32_t* base, const Index* index, real& fourth) {
    real w;
    const vec3 bits = gather_blocks(reinterpret_cast<const float*>(base), index, w);
    const auto number = [](real x) {
        return real(hn::ConvertTo(D(), hn::BitCast(hn::Rebind<std::int32_t, D>(), x.v)));
    };
    fourth = number(w);
    return vec3(number(bits.x), number(bits.y), number(bits.z));
}

// Stores integral numbers as blocks of integers.
WEFT_FN void store_integer_blocks(vec3 v, real fourth, std::int32_t* p) {
    const hn::Rebind<std::int32_t, D> tag;
    const auto integers = [&](real x) { return hn::ConvertTo(tag, x.v); };
    hn::StoreInterleaved4(integers(v.x), integers(v.y), integers(v.z), integers(fourth), tag, p);
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
    fourth = real(at[3]);
    return vec3(real(at[0]), real(at[1]), real(at[2]));
}
// The float of each lane's word.
WEFT_FN real number_of(ShapeBlocks d, real word) {
    return hn::GatherIndex(D(), d.words, hn::ConvertTo(hn::Rebind<std::int32_t, D>(), word.v));
}
// The eight signed 16-bit integers of each lane's block; the first one is the lower half of the first word.
WEFT_FN Shorts shorts_of(ShapeBlocks d, real block) {
    const hn::Rebind<std::int32_t, D> tag;
    HWY_ALIGN std::int32_t index[16];
    hn::Store(hn::ConvertTo(tag, block.v), tag, index);
    real w;
    const vec3 words = gather_blocks(d.words, index, w);
    const auto low = [&](real x) {
        return real(hn::ConvertTo(D(), hn::ShiftRight<16>(hn::ShiftLeft<16>(hn::BitCast(tag, x.v)))));
    };
    const auto high = [&](real x) { return real(hn::ConvertTo(D(), hn::ShiftRight<16>(hn::BitCast(tag, x.v)))); };
    return {low(words.x), high(words.x), low(words.y), high(words.y), low(words.z), high(words.z), low(w), high(w)};
}

WEFT_FN void scatter_blocks(vec3 v, real fourth, float* base, const std::uint32_t* index) {
    V r0 = v.x.v, r1 = v.y.v, r2 = v.z.v, r3 = fourth.v;
    transpose_blocks(r0, r1, r2, r3);
    store_parts(D(), r0, base, index), store_parts(D(), r1, base, index + 1);
    store_parts(D(), r2, base, index + 2), store_parts(D(), r3, base, index + 3);
}

}  // namespace weft::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
