// C++ macros of the common subset of C++ and GLSL, shared by every lane width. GLSL's are in lanes.glsl.
#pragma once

#define WEFT_FN inline __attribute__((always_inline))
// A function that is large or rarely runs.
#define WEFT_OUTLINED_FN inline __attribute__((noinline))
#define inout_(T) T&
#define out_(T) T&
#define WEFT_ROW_MEMBER(name) real name;

// Kernels of one kind share one signature; not all of them use every parameter.
#pragma GCC diagnostic ignored "-Wunused-parameter"
