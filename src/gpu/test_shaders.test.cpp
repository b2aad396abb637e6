#include "gpu/test_device.h"

#include <algorithm>
#include <iterator>

namespace weft::gpu {
namespace {

#include <test_shaders.inc>

}  // namespace

const Shader& test_shader(std::string_view name) {
    const auto it = std::ranges::find(test_shaders, name, &Shader::name);
    EXPECT_NE(it, std::end(test_shaders)) << name;
    return it == std::end(test_shaders) ? test_shaders[0] : *it;
}

}  // namespace weft::gpu
