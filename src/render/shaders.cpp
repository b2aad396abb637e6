#include "render/shaders.h"

#include <algorithm>
#include <cassert>

namespace weft::render {
namespace {

#include "render_shader_table.inc"

}  // namespace

const gpu::Shader& shader(std::string_view name) {
    const auto found = std::ranges::find(render_shader_table, name, &gpu::Shader::name);
    assert(found != std::end(render_shader_table));
    return *found;
}

}  // namespace weft::render
