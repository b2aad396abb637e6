// The rows and materials of every constraint. Read by C++ and by GLSL.
//
// The preprocessor cannot make an #include from constraints.def: a new constraint is named here too, and its kernel in
// kernels.inl.
#ifndef WEFT_CONSTRAINTS_DATA_H
#define WEFT_CONSTRAINTS_DATA_H

#include "physics/adhesion/adhesion.data.h"
#include "physics/attachment/attachment.data.h"
#include "physics/bend/bend.data.h"
#include "physics/flexion/flexion.data.h"
#include "physics/plate/plate.data.h"
#include "physics/reach/reach.data.h"
#include "physics/stitch/stitch.data.h"
#include "physics/stretch/stretch.data.h"
#include "physics/tether/tether.data.h"

#ifdef __cplusplus
#include "physics/constraint_parts.h"
#endif

#endif
