#include "gpu/pipeline.h"

#include "base/workers.h"
#include "gpu/device.h"
#include "gpu/pipeline_layout.h"

#include <algorithm>
#include <atomic>
#include <string>
#include <thread>
#include <utility>

namespace weft::gpu {
namespace {

Result<void> check_workgroup(const Device& device, const ShaderInterface& interface, const std::string& name) {
    const DeviceLimits& limits = device.limits();
    std::uint64_t invocations = 1;
    for (unsigned axis = 0; axis < 3; ++axis) {
        const std::uint32_t size = interface.workgroup[axis];
        if (size == 0 || size > limits.workgroup_size[axis])
            return over_limit(device, name, size, std::string("invocations along ") + "xyz"[axis],
                              limits.workgroup_size[axis]);
        invocations *= size;
    }
    if (invocations > limits.workgroup_invocations)
        return over_limit(device, name, invocations, "invocations in a workgroup", limits.workgroup_invocations);
    return {};
}

}  // namespace

Result<Pipeline> Pipeline::create(const Device& device, const Shader& shader,
                                  std::span<const std::uint32_t> constants) {
    auto prepared = prepare(device, shader, constants);
    if (!prepared) return prepared;
    if (auto compiled = prepared->compile(); !compiled) return compiled.errors();
    return prepared;
}

Result<Pipeline> Pipeline::prepare(const Device& device, const Shader& shader,
                                   std::span<const std::uint32_t> constants) {
    auto interface = reflect(shader);
    if (!interface) return interface.errors();
    const std::string name(shader.name);
    Pipeline self;
    self.device_ = &device;
    self.shader_ = shader;
    self.constants_.assign(constants.begin(), constants.end());
    self.interface_ = std::move(*interface);
    for (unsigned axis = 0; axis < 3; ++axis) {
        const auto id = self.interface_.workgroup_constants[axis];
        if (id && *id < constants.size()) self.interface_.workgroup[axis] = constants[*id];
    }
    if (auto fits = check_workgroup(device, self.interface_, name); !fits) return fits.errors();
    auto layout = PipelineLayout::create(device, self.interface_, VK_SHADER_STAGE_COMPUTE_BIT, name);
    if (!layout) return layout.errors();
    self.layout_ = std::move(*layout);
    return self;
}

Result<void> Pipeline::compile() const {
    if (compiled()) return {};
    const Device& device = *device_;
    const std::string name(shader_.name);
    std::vector<std::uint32_t> words = with_exact_arithmetic(shader_.words);
    set_constants(words, constants_);
    VkShaderModuleCreateInfo module_info{};
    module_info.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
    module_info.codeSize = words.size() * sizeof(std::uint32_t);
    module_info.pCode = words.data();
    VkShaderModule module = VK_NULL_HANDLE;
    const auto& vk = device.vk();
    VkResult result = vk.vkCreateShaderModule(device.handle(), &module_info, nullptr, &module);
    if (result != VK_SUCCESS) return device.error("to load '" + name + "'", result);

    std::vector<VkSpecializationMapEntry> entries;
    for (std::uint32_t i = 0; i < constants_.size(); ++i) {
        entries.push_back({i, i * static_cast<std::uint32_t>(sizeof(std::uint32_t)), sizeof(std::uint32_t)});
    }
    const VkSpecializationInfo specialization{static_cast<std::uint32_t>(entries.size()), entries.data(),
                                              constants_.size() * sizeof(std::uint32_t), constants_.data()};
    VkComputePipelineCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
    info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
    info.stage.module = module;
    info.stage.pName = "main";
    info.stage.pSpecializationInfo = constants_.empty() ? nullptr : &specialization;
    info.layout = layout_.handle();
    result = vk.vkCreateComputePipelines(device.handle(), device.pipeline_cache(), 1, &info, nullptr, &pipeline_);
    vk.vkDestroyShaderModule(device.handle(), module, nullptr);
    if (result != VK_SUCCESS) {
        pipeline_ = VK_NULL_HANDLE;
        return device.error("to compile '" + name + "'", result);
    }
    device.name(VK_OBJECT_TYPE_PIPELINE, reinterpret_cast<std::uint64_t>(pipeline_), name);
    return {};
}

Result<void> compile_together(std::span<const Pipeline* const> pipelines) {
    std::vector<const Pipeline*> missing(pipelines.begin(), pipelines.end());
    std::erase_if(missing, [](const Pipeline* one) { return one->compiled(); });
    std::ranges::sort(missing);
    missing.erase(std::unique(missing.begin(), missing.end()), missing.end());
    if (missing.empty()) return {};
    const auto processors = std::max(1u, std::thread::hardware_concurrency());
    WorkerTeam team(static_cast<unsigned>(std::min<std::size_t>(processors, missing.size())) - 1);
    std::vector<Errors> errors(missing.size());
    std::atomic<std::size_t> next = 0;
    team.run([&](unsigned) {
        for (std::size_t i = next++; i < missing.size(); i = next++)
            if (auto compiled = missing[i]->compile(); !compiled) errors[i] = compiled.errors();
    });
    Errors all;
    for (const Errors& some : errors) all.insert(all.end(), some.begin(), some.end());
    if (!all.empty()) return all;
    return {};
}

Pipeline::~Pipeline() {
    if (!device_) return;
    const auto& vk = device_->vk();
    if (pipeline_ != VK_NULL_HANDLE) vk.vkDestroyPipeline(device_->handle(), pipeline_, nullptr);
}

void Pipeline::swap(Pipeline& other) {
    std::swap(device_, other.device_);
    std::swap(shader_, other.shader_);
    std::swap(constants_, other.constants_);
    std::swap(interface_, other.interface_);
    std::swap(layout_, other.layout_);
    std::swap(pipeline_, other.pipeline_);
}

}  // namespace weft::gpu
