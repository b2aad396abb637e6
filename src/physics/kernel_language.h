// Spelling of the common subset in C++, shared by every lane width. GLSL's is in lanes.glsl.
#pragma once

#define WEFT_FN inline __attribute__((always_inline))
#define inout_(T) T&
#define out_(T) T&
#define WEFT_ROW_MEMBER(name) real name;

// Kernels of one kind share one signature, which not all of them need in full.
#pragma GCC diagnostic ignored "-Wunused-parameter"
