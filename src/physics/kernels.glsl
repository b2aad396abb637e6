// Every kernel for a shader: what C++ puts together from lanes.h, the *.data.h files and kernels.inl.
#ifndef WEFT_KERNELS_GLSL
#define WEFT_KERNELS_GLSL

#include "physics/lanes.glsl"

#include "physics/constraints.data.h"

#include "physics/kernels.inl"

#endif
