// The shaders that the build has embedded.
#pragma once

#include "gpu/spirv.h"

#include <string_view>

namespace weft::render {

/// The shader by the name of its file: `lit_frag` for lit.frag.
const gpu::Shader& shader(std::string_view name);

}  // namespace weft::render
