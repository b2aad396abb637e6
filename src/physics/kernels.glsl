// All kernels for shaders. C++ gets the same from lanes.h, the *.data.h files and kernels.inl.
#ifndef WEFT_KERNELS_GLSL
#define WEFT_KERNELS_GLSL

#include "physics/lanes.glsl"

#include "physics/constraints.data.h"

#include "physics/kernels.inl"

#endif
