// The shaders that the build has embedded.
#pragma once

#include "gpu/spirv.h"

#include <span>
#include <string_view>

namespace weft::vulkan {

std::span<const gpu::Shader> shaders();
/// The shader of that name, which must be one of them.
const gpu::Shader& find_shader(std::string_view name);
/// Its index in shaders().
std::uint32_t shader_number(std::string_view name);

}  // namespace weft::vulkan
