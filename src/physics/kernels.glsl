// Every kernel for a shader: what C++ puts together from lanes.h, the *.data.h files and kernels.inl.
#ifndef WEFT_KERNELS_GLSL
#define WEFT_KERNELS_GLSL

#include "physics/lanes.glsl"

#include "physics/attachment/attachment.data.h"
#include "physics/bend/bend.data.h"
#include "physics/flexion/flexion.data.h"
#include "physics/plate/plate.data.h"
#include "physics/reach/reach.data.h"
#include "physics/stretch/stretch.data.h"
#include "physics/tether/tether.data.h"

#include "physics/kernels.inl"

#endif
