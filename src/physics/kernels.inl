// Every kernel, to be included inside a namespace that has the lanes. Kernels carry no include guards: each namespace
// compiles its own copy of the same text. The *.data.h files come before, outside any namespace. The preprocessor
// cannot make an #include from constraints.def, so a new constraint or wind is named here too.

// clang-format off: each file builds on those before it
#include "physics/trigonometry.kernel.h"
#include "physics/accumulate.kernel.h"
#include "physics/integrate/integrate.kernel.h"
#include "physics/surface/normals.kernel.h"
#include "physics/surface/tangents.kernel.h"
#include "physics/surface/follow.kernel.h"

#include "physics/air/noise.kernel.h"
#include "physics/air/wind.kernel.h"
#include "physics/air/directional.kernel.h"
#include "physics/air/air.kernel.h"

#include "physics/tether/tether.kernel.h"
#include "physics/attachment/attachment.kernel.h"
#include "physics/reach/reach.kernel.h"
#include "physics/stretch/stretch.kernel.h"
#include "physics/stretch/line.kernel.h"
#include "physics/bend/bend.kernel.h"
#include "physics/plate/plate.kernel.h"
#include "physics/flexion/flexion.kernel.h"
#include "physics/stitch/stitch.kernel.h"
#include "physics/adhesion/adhesion.kernel.h"

#include "physics/contact/contact.kernel.h"
#include "physics/contact/feedback.kernel.h"
#define WEFT_SHAPE_KERNELS
#include "physics/contact/shapes.def"
#undef WEFT_SHAPE_KERNELS
// clang-format on
