// Includes all public headers except <weft/vulkan.h>. The interface uses only types of the standard library.
#pragma once

#include <weft/bounds.h>
#include <weft/contact_forces.h>
#include <weft/export.h>
#include <weft/files.h>
#include <weft/grab.h>
#include <weft/ids.h>
#include <weft/mesh.h>
#include <weft/result.h>
#include <weft/scene.h>
#include <weft/simulation.h>
#include <weft/vector.h>

namespace weft {

/// "major.minor.patch"
WEFT_API const char* version();

}  // namespace weft
