#include "vulkan/programs.h"

#include "vulkan/shaders.h"

#include <algorithm>
#include <array>

namespace weft::vulkan {
namespace {

// Invocations of a workgroup: enough to hide memory latency, few enough to leave registers for each.
constexpr std::uint32_t usual_workgroup = 128;

}  // namespace

Result<const gpu::Pipeline*> Programs::get(std::string_view name) {
    const std::array constants = {std::min(usual_workgroup, device_.limits().workgroup_size[0])};
    return get(name, constants);
}

Result<const gpu::Pipeline*> Programs::get(std::string_view name, std::span<const std::uint32_t> constants) {
    std::string key(name);
    for (const std::uint32_t constant : constants) key += ' ' + std::to_string(constant);
    if (const auto it = made_.find(key); it != made_.end()) return it->second.get();
    auto pipeline = gpu::Pipeline::prepare(device_, find_shader(name), constants);
    if (!pipeline) return pipeline.errors();
    const auto made = made_.emplace(std::move(key), std::make_unique<gpu::Pipeline>(std::move(*pipeline)));
    return made.first->second.get();
}

}  // namespace weft::vulkan
