// All kernels, to be included inside a namespace that defines the lanes. Kernels have no include guards: each namespace
// compiles its own copy of the same text. Include the *.data.h files before, outside any namespace. The preprocessor
// cannot generate an #include from constraints.def, so list a new constraint here too.

// clang-format off: each file depends on those before it
#include "physics/trigonometry.kernel.h"
#include "physics/exponential.kernel.h"
#include "physics/accumulate.kernel.h"
#include "physics/integrate/integrate.kernel.h"
#include "physics/sweep.kernel.h"
#include "physics/pin_load/pin_load.kernel.h"
#include "physics/body/body.kernel.h"
#include "physics/surface/normals.kernel.h"
#include "physics/surface/tangents.kernel.h"
#include "physics/surface/follow.kernel.h"

#include "physics/air/noise.kernel.h"
#include "physics/air/wind.kernel.h"
#define WEFT_WIND_KERNELS
#include "physics/air/winds.def"
#undef WEFT_WIND_KERNELS
#include "physics/air/air.kernel.h"

#include "physics/tether/tether.kernel.h"
#include "physics/attachment/attachment.kernel.h"
#include "physics/coarse_limit/coarse_limit.kernel.h"
#include "physics/stretch/stretch.kernel.h"
#include "physics/stretch/line.kernel.h"
#include "physics/stretch/taut.kernel.h"
#include "physics/tear/tear.kernel.h"
#include "physics/bend/bend.kernel.h"
#include "physics/moment/moment.kernel.h"
#include "physics/coupled.kernel.h"
#include "physics/plate/plate.kernel.h"
#include "physics/membrane/membrane.kernel.h"
#include "physics/distance_bend/distance_bend.kernel.h"
#include "physics/stitch/stitch.kernel.h"
#include "physics/adhesion/adhesion.kernel.h"
#include "physics/grab/grab.kernel.h"

#include "physics/contact/contact.kernel.h"
#include "physics/contact/contact_forces.kernel.h"
#include "physics/cloth_contact/cloth_contact.kernel.h"
#include "physics/cloth_contact/limit.kernel.h"
#include "physics/cloth_contact/untangle.kernel.h"
#include "physics/particle_contact/particle_contact.kernel.h"
#define WEFT_SHAPE_KERNELS
#include "physics/contact/shapes.def"
#undef WEFT_SHAPE_KERNELS
#include "physics/contact/swept.kernel.h"
#include "physics/contact/face.kernel.h"
#include "physics/body/support.kernel.h"
#include "physics/body/body_contact.kernel.h"
#include "physics/air/shelter.kernel.h"
// clang-format on
