// GLSL side of the common subset in which *.kernel.h files are written. One invocation is one lane.
// The C++ side is lanes.h (SIMD) and lanes_scalar.inl (one float or double).
#ifndef WEFT_LANES_GLSL
#define WEFT_LANES_GLSL

#define WEFT_FN
#define WEFT_OUTLINED_FN
#define inout_(T) inout T
#define out_(T) out T

#define real float
#define mask bool

// A constraint's numbers as members of its struct: WEFT_ROW_<name>(WEFT_ROW_MEMBER).
#define WEFT_ROW_MEMBER(name) real name;

real select(mask m, real yes, real no) { return m ? yes : no; }
vec3 select(mask m, vec3 yes, vec3 no) { return m ? yes : no; }
bool any(mask m) { return m; }

// Data of a shape. A block or a word of its own for each lane is numbered by a whole number from 0 to 2^24.
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : require
layout(buffer_reference, std430, buffer_reference_align = 16) readonly buffer ShapeBlocksRef {
    uvec4 at[];
};
// The address as two words, because some drivers cannot compile variables that hold a reference.
struct ShapeBlocks {
    uvec2 address;
};
uvec4 block_at(ShapeBlocks d, int block) { return ShapeBlocksRef(d.address).at[block]; }

struct Shorts {
    real s0, s1, s2, s3, s4, s5, s6, s7;
};
// Integers of one word or block, the same for all lanes.
int integer_of(ShapeBlocks d, int word) { return int(block_at(d, word >> 2)[word & 3]); }
vec3 block_of(ShapeBlocks d, int block, out real fourth)
{
    vec4 v = uintBitsToFloat(block_at(d, block));
    fourth = v.w;
    return v.xyz;
}
// The float of each lane's word.
real number_of(ShapeBlocks d, real word)
{
    int i = int(word);
    return uintBitsToFloat(block_at(d, i >> 2)[i & 3]);
}
// The eight signed 16-bit integers of each lane's block; the first one is the lower half of the first word.
Shorts shorts_of(ShapeBlocks d, real block)
{
    ivec4 words = ivec4(block_at(d, int(block)));
    ivec4 low = (words << 16) >> 16, high = words >> 16;
    return Shorts(real(low.x), real(high.x), real(low.y), real(high.y), real(low.z), real(high.z), real(low.w),
                  real(high.w));
}

#endif
