// The numbers and materials of every constraint. Read by C++ and by GLSL.
//
// The preprocessor cannot generate an #include from constraints.def, so list a new constraint here too, and its kernel
// in kernels.inl.
#ifndef WEFT_CONSTRAINTS_DATA_H
#define WEFT_CONSTRAINTS_DATA_H

#include "physics/adhesion/adhesion.data.h"
#include "physics/attachment/attachment.data.h"
#include "physics/bend/bend.data.h"
#include "physics/distance_bend/distance_bend.data.h"
#include "physics/plate/plate.data.h"
#include "physics/coarse_limit/coarse_limit.data.h"
#include "physics/stitch/stitch.data.h"
#include "physics/stretch/stretch.data.h"
#include "physics/membrane/membrane.data.h"
#include "physics/moment/moment.data.h"
#include "physics/tether/tether.data.h"

#ifdef __cplusplus
#include "physics/constraint_parts.h"
#endif

#endif
