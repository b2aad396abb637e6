#include "gpu/pipeline_layout.h"

#include "gpu/device.h"

namespace weft::gpu {

Error over_limit(const Device& device, const std::string& name, std::uint64_t needed, const std::string& of_what,
                 std::uint64_t most) {
    return Error::of_machine(device.info().name, "'" + name + "' needs " + std::to_string(needed) + " " + of_what +
                                                     ", the device has " + std::to_string(most));
}

namespace {

Result<void> check_interface(const Device& device, const ShaderInterface& interface, const std::string& name) {
    const DeviceLimits& limits = device.limits();
    if (interface.push_constants > limits.push_constants)
        return over_limit(device, name, interface.push_constants, "bytes of push constants", limits.push_constants);
    if (!interface.bindings.empty() && interface.bindings.back().set >= limits.descriptor_sets)
        return over_limit(device, name, std::uint64_t{interface.bindings.back().set} + 1, "descriptor sets",
                          limits.descriptor_sets);
    return {};
}

// Drawing has one uniform buffer for a whole frame, and each draw command has its part of it.
VkDescriptorType type_of(const ShaderBinding& binding, VkShaderStageFlags stages) {
    if (binding.image) return VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
    if (binding.uniform && (stages & VK_SHADER_STAGE_VERTEX_BIT)) return VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC;
    return binding.uniform ? VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER : VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
}

}  // namespace

Result<PipelineLayout> PipelineLayout::create(const Device& device, const ShaderInterface& interface,
                                              VkShaderStageFlags stages, const std::string& name) {
    if (auto fits = check_interface(device, interface, name); !fits) return fits.errors();
    PipelineLayout self;
    self.device_ = &device;
    const auto& vk = device.vk();
    const std::uint32_t count = interface.bindings.empty() ? 0 : interface.bindings.back().set + 1;
    for (std::uint32_t set = 0; set < count; ++set) {
        std::vector<VkDescriptorSetLayoutBinding> bindings;
        for (const ShaderBinding& one : interface.bindings) {
            if (one.set != set) continue;
            VkDescriptorSetLayoutBinding binding{};
            binding.binding = one.binding;
            binding.descriptorType = type_of(one, stages);
            binding.descriptorCount = 1;
            binding.stageFlags = stages;
            bindings.push_back(binding);
        }
        VkDescriptorSetLayoutCreateInfo info{};
        info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
        info.bindingCount = static_cast<std::uint32_t>(bindings.size());
        info.pBindings = bindings.data();
        VkDescriptorSetLayout layout = VK_NULL_HANDLE;
        const VkResult result = vk.vkCreateDescriptorSetLayout(device.handle(), &info, nullptr, &layout);
        if (result != VK_SUCCESS) return device.error("to lay out what '" + name + "' reads", result);
        self.sets_.push_back(layout);
    }
    const VkPushConstantRange push{stages, 0, interface.push_constants};
    VkPipelineLayoutCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
    info.setLayoutCount = static_cast<std::uint32_t>(self.sets_.size());
    info.pSetLayouts = self.sets_.data();
    info.pushConstantRangeCount = push.size > 0 ? 1 : 0;
    info.pPushConstantRanges = &push;
    const VkResult result = vk.vkCreatePipelineLayout(device.handle(), &info, nullptr, &self.layout_);
    if (result != VK_SUCCESS) return device.error("to lay out '" + name + "'", result);
    return self;
}

PipelineLayout::~PipelineLayout() {
    if (!device_) return;
    const auto& vk = device_->vk();
    if (layout_ != VK_NULL_HANDLE) vk.vkDestroyPipelineLayout(device_->handle(), layout_, nullptr);
    for (VkDescriptorSetLayout set : sets_) vk.vkDestroyDescriptorSetLayout(device_->handle(), set, nullptr);
}

void PipelineLayout::swap(PipelineLayout& other) {
    std::swap(device_, other.device_);
    std::swap(sets_, other.sets_);
    std::swap(layout_, other.layout_);
}

}  // namespace weft::gpu
