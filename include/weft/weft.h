// Everything of weft. Standard library types only.
#pragma once

#include <weft/export.h>
#include <weft/result.h>
#include <weft/simulation.h>
#include <weft/vector.h>

namespace weft {

/// "major.minor.patch"
WEFT_API const char* version();

}  // namespace weft
