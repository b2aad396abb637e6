// GLSL side of the common subset in which *.kernel.h files are written. One invocation is one lane.
// The C++ side is lanes.h (SIMD) and lanes_scalar.inl (one float or double).
#ifndef WEFT_LANES_GLSL
#define WEFT_LANES_GLSL

#define WEFT_FN
#define inout_(T) inout T
#define out_(T) out T

#define real float
#define mask bool

// A constraint's numbers as members of its struct: WEFT_ROW_<name>(WEFT_ROW_MEMBER).
#define WEFT_ROW_MEMBER(name) real name;

real select(mask m, real yes, real no) { return m ? yes : no; }
vec3 select(mask m, vec3 yes, vec3 no) { return m ? yes : no; }
bool any(mask m) { return m; }

#endif
