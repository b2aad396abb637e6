#include "vulkan/shaders.h"

#include <algorithm>
#include <cassert>

namespace weft::vulkan {
namespace {

#include <vulkan_shaders.inc>

}  // namespace

std::span<const gpu::Shader> shaders() {
    return vulkan_shaders;
}

const gpu::Shader& find_shader(std::string_view name) {
    const auto it = std::ranges::find(vulkan_shaders, name, &gpu::Shader::name);
    assert(it != std::end(vulkan_shaders));
    return *it;
}

std::uint32_t shader_number(std::string_view name) {
    return static_cast<std::uint32_t>(&find_shader(name) - vulkan_shaders);
}

}  // namespace weft::vulkan
