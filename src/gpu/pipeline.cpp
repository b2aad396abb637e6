#include "gpu/pipeline.h"

#include "gpu/device.h"

#include <algorithm>
#include <string>
#include <utility>

namespace weft::gpu {
namespace {

Result<std::vector<VkDescriptorSetLayout>> make_sets(const Device& device, const ShaderInterface& interface,
                                                     const std::string& name) {
    std::vector<VkDescriptorSetLayout> sets;
    const std::uint32_t count = interface.bindings.empty() ? 0 : interface.bindings.back().set + 1;
    for (std::uint32_t set = 0; set < count; ++set) {
        std::vector<VkDescriptorSetLayoutBinding> bindings;
        for (const ShaderBinding& one : interface.bindings) {
            if (one.set != set) continue;
            VkDescriptorSetLayoutBinding binding{};
            binding.binding = one.binding;
            binding.descriptorType =
                one.uniform ? VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER : VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
            binding.descriptorCount = 1;
            binding.stageFlags = VK_SHADER_STAGE_COMPUTE_BIT;
            bindings.push_back(binding);
        }
        VkDescriptorSetLayoutCreateInfo info{};
        info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
        info.bindingCount = static_cast<std::uint32_t>(bindings.size());
        info.pBindings = bindings.data();
        VkDescriptorSetLayout layout = VK_NULL_HANDLE;
        const VkResult result = device.vk().vkCreateDescriptorSetLayout(device.handle(), &info, nullptr, &layout);
        if (result != VK_SUCCESS) {
            for (VkDescriptorSetLayout made : sets)
                device.vk().vkDestroyDescriptorSetLayout(device.handle(), made, nullptr);
            return device.error("to lay out what '" + name + "' reads", result);
        }
        sets.push_back(layout);
    }
    return sets;
}

Result<Done> check_limits(const Device& device, const ShaderInterface& interface, const std::string& name) {
    const DeviceLimits& limits = device.limits();
    const auto too_much = [&](std::uint64_t needed, const std::string& of_what, std::uint64_t most) {
        return Error::of_machine(device.info().name, "'" + name + "' needs " + std::to_string(needed) + " " + of_what +
                                                         ", the device has " + std::to_string(most));
    };
    if (interface.push_constants > limits.push_constants)
        return too_much(interface.push_constants, "bytes of push constants", limits.push_constants);
    if (!interface.bindings.empty() && interface.bindings.back().set >= limits.descriptor_sets)
        return too_much(std::uint64_t{interface.bindings.back().set} + 1, "descriptor sets", limits.descriptor_sets);
    std::uint64_t invocations = 1;
    for (unsigned axis = 0; axis < 3; ++axis) {
        const std::uint32_t size = interface.workgroup[axis];
        if (size == 0 || size > limits.workgroup_size[axis])
            return too_much(size, std::string("invocations along ") + "xyz"[axis], limits.workgroup_size[axis]);
        invocations *= size;
    }
    if (invocations > limits.workgroup_invocations)
        return too_much(invocations, "invocations in a workgroup", limits.workgroup_invocations);
    return Done{};
}

}  // namespace

Result<Pipeline> Pipeline::create(const Device& device, const Shader& shader,
                                  std::span<const std::uint32_t> constants) {
    auto interface = reflect(shader);
    if (!interface) return interface.errors();
    const std::string name(shader.name);
    Pipeline self;
    self.device_ = &device;
    self.interface_ = std::move(*interface);
    for (unsigned axis = 0; axis < 3; ++axis) {
        const auto id = self.interface_.workgroup_constants[axis];
        if (id && *id < constants.size()) self.interface_.workgroup[axis] = constants[*id];
    }
    if (auto fits = check_limits(device, self.interface_, name); !fits) return fits.errors();
    auto sets = make_sets(device, self.interface_, name);
    if (!sets) return sets.errors();
    self.sets_ = std::move(*sets);

    const VkPushConstantRange push{VK_SHADER_STAGE_COMPUTE_BIT, 0, self.interface_.push_constants};
    VkPipelineLayoutCreateInfo layout{};
    layout.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
    layout.setLayoutCount = static_cast<std::uint32_t>(self.sets_.size());
    layout.pSetLayouts = self.sets_.data();
    layout.pushConstantRangeCount = push.size > 0 ? 1 : 0;
    layout.pPushConstantRanges = &push;
    const auto& vk = device.vk();
    VkResult result = vk.vkCreatePipelineLayout(device.handle(), &layout, nullptr, &self.layout_);
    if (result != VK_SUCCESS) return device.error("to lay out '" + name + "'", result);

    std::vector<std::uint32_t> words = with_exact_arithmetic(shader.words);
    set_constants(words, constants);
    VkShaderModuleCreateInfo module_info{};
    module_info.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
    module_info.codeSize = words.size() * sizeof(std::uint32_t);
    module_info.pCode = words.data();
    VkShaderModule module = VK_NULL_HANDLE;
    result = vk.vkCreateShaderModule(device.handle(), &module_info, nullptr, &module);
    if (result != VK_SUCCESS) return device.error("to load '" + name + "'", result);

    std::vector<VkSpecializationMapEntry> entries;
    for (std::uint32_t i = 0; i < constants.size(); ++i) {
        entries.push_back({i, i * static_cast<std::uint32_t>(sizeof(std::uint32_t)), sizeof(std::uint32_t)});
    }
    const VkSpecializationInfo specialization{static_cast<std::uint32_t>(entries.size()), entries.data(),
                                              constants.size_bytes(), constants.data()};
    VkComputePipelineCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
    info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
    info.stage.module = module;
    info.stage.pName = "main";
    info.stage.pSpecializationInfo = constants.empty() ? nullptr : &specialization;
    info.layout = self.layout_;
    result = vk.vkCreateComputePipelines(device.handle(), device.pipeline_cache(), 1, &info, nullptr, &self.pipeline_);
    vk.vkDestroyShaderModule(device.handle(), module, nullptr);
    if (result != VK_SUCCESS) return device.error("to compile '" + name + "'", result);
    device.name(VK_OBJECT_TYPE_PIPELINE, reinterpret_cast<std::uint64_t>(self.pipeline_), name);
    return self;
}

Pipeline::~Pipeline() {
    if (!device_) return;
    const auto& vk = device_->vk();
    if (pipeline_ != VK_NULL_HANDLE) vk.vkDestroyPipeline(device_->handle(), pipeline_, nullptr);
    if (layout_ != VK_NULL_HANDLE) vk.vkDestroyPipelineLayout(device_->handle(), layout_, nullptr);
    for (VkDescriptorSetLayout set : sets_) vk.vkDestroyDescriptorSetLayout(device_->handle(), set, nullptr);
}

void Pipeline::swap(Pipeline& other) {
    std::swap(device_, other.device_);
    std::swap(interface_, other.interface_);
    std::swap(sets_, other.sets_);
    std::swap(layout_, other.layout_);
    std::swap(pipeline_, other.pipeline_);
}

}  // namespace weft::gpu
