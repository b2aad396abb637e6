// The layout of a pipeline: descriptor sets and push constants, as its shaders declare them.
#pragma once

#include "gpu/spirv.h"
#include "gpu/vulkan.h"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace weft::gpu {

class Device;

/// The error that shader `name` needs more of a resource than the device has.
Error over_limit(const Device& device, const std::string& name, std::uint64_t needed, const std::string& of_what,
                 std::uint64_t most);

class PipelineLayout {
  public:
    /// Fails if the device does not support so many push constants or sets.
    static Result<PipelineLayout> create(const Device& device, const ShaderInterface& interface,
                                         VkShaderStageFlags stages, const std::string& name);
    PipelineLayout() = default;
    PipelineLayout(PipelineLayout&& other) noexcept { swap(other); }
    PipelineLayout& operator=(PipelineLayout&& other) noexcept {
        PipelineLayout(std::move(other)).swap(*this);
        return *this;
    }
    ~PipelineLayout();

    VkPipelineLayout handle() const { return layout_; }
    const std::vector<VkDescriptorSetLayout>& sets() const { return sets_; }

  private:
    void swap(PipelineLayout& other);

    const Device* device_ = nullptr;
    std::vector<VkDescriptorSetLayout> sets_;
    VkPipelineLayout layout_ = VK_NULL_HANDLE;
};

}  // namespace weft::gpu
