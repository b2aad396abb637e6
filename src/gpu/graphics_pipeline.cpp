#include "gpu/graphics_pipeline.h"

#include "gpu/device.h"

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>

namespace weft::gpu {
namespace {

/// A shader module, needed only while a pipeline is created.
class Module {
  public:
    static Result<Module> create(const Device& device, const Shader& shader) {
        Module self;
        self.device_ = &device;
        VkShaderModuleCreateInfo info{};
        info.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
        info.codeSize = shader.words.size_bytes();
        info.pCode = shader.words.data();
        const VkResult result = device.vk().vkCreateShaderModule(device.handle(), &info, nullptr, &self.module_);
        if (result != VK_SUCCESS) return device.error("to load '" + std::string(shader.name) + "'", result);
        return self;
    }
    Module(Module&& other) noexcept
        : device_(std::exchange(other.device_, nullptr)), module_(std::exchange(other.module_, VK_NULL_HANDLE)) {}
    ~Module() {
        if (module_ != VK_NULL_HANDLE) device_->vk().vkDestroyShaderModule(device_->handle(), module_, nullptr);
    }
    VkShaderModule handle() const { return module_; }

  private:
    Module() = default;
    const Device* device_ = nullptr;
    VkShaderModule module_ = VK_NULL_HANDLE;
};

// Union of the declarations of both shaders.
ShaderInterface join(ShaderInterface a, const ShaderInterface& b) {
    a.push_constants = std::max(a.push_constants, b.push_constants);
    a.bindings.insert(a.bindings.end(), b.bindings.begin(), b.bindings.end());
    const auto place = [](const ShaderBinding& one) { return std::tuple(one.set, one.binding); };
    std::ranges::sort(a.bindings, {}, place);
    const auto twice = std::ranges::unique(a.bindings, {}, place);
    a.bindings.erase(twice.begin(), twice.end());
    return a;
}

VkPipelineColorBlendAttachmentState blend_state(Blend blend) {
    VkPipelineColorBlendAttachmentState state{};
    state.colorWriteMask =
        VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT | VK_COLOR_COMPONENT_B_BIT | VK_COLOR_COMPONENT_A_BIT;
    state.blendEnable = blend != Blend::none;
    const bool over = blend == Blend::over;
    state.srcColorBlendFactor = over ? VK_BLEND_FACTOR_SRC_ALPHA : VK_BLEND_FACTOR_ONE;
    state.dstColorBlendFactor = over ? VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA : VK_BLEND_FACTOR_ONE;
    state.srcAlphaBlendFactor = VK_BLEND_FACTOR_ONE;
    state.dstAlphaBlendFactor = over ? VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA : VK_BLEND_FACTOR_ONE;
    return state;
}

struct Stages {
    std::array<VkPipelineShaderStageCreateInfo, 2> infos{};
    std::uint32_t count = 1;
};

Stages stages_of(VkShaderModule vertex, VkShaderModule fragment, const VkSpecializationInfo* constants) {
    Stages stages;
    for (auto& info : stages.infos) {
        info.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
        info.pName = "main";
        info.pSpecializationInfo = constants;
    }
    stages.infos[0].stage = VK_SHADER_STAGE_VERTEX_BIT;
    stages.infos[0].module = vertex;
    stages.infos[1].stage = VK_SHADER_STAGE_FRAGMENT_BIT;
    stages.infos[1].module = fragment;
    if (fragment != VK_NULL_HANDLE) stages.count = 2;
    return stages;
}

VkResult make_pipeline(const Device& device, const RenderPass& pass, const Stages& stages, const GraphicsState& state,
                       VkPipelineLayout layout, VkPipeline& pipeline) {
    VkPipelineVertexInputStateCreateInfo vertices{};
    vertices.sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO;
    VkPipelineInputAssemblyStateCreateInfo assembly{};
    assembly.sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO;
    assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
    VkPipelineViewportStateCreateInfo viewport{};
    viewport.sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO;
    viewport.viewportCount = viewport.scissorCount = 1;
    VkPipelineRasterizationStateCreateInfo raster{};
    raster.sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO;
    raster.polygonMode = VK_POLYGON_MODE_FILL;
    raster.cullMode = state.cull;
    raster.frontFace = VK_FRONT_FACE_COUNTER_CLOCKWISE;
    raster.lineWidth = 1;
    raster.depthBiasEnable = state.depth_bias != 0 || state.slope_bias != 0;
    raster.depthBiasConstantFactor = state.depth_bias;
    raster.depthBiasSlopeFactor = state.slope_bias;
    VkPipelineMultisampleStateCreateInfo multisample{};
    multisample.sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO;
    multisample.rasterizationSamples = static_cast<VkSampleCountFlagBits>(pass.attachments().front().samples);
    VkPipelineDepthStencilStateCreateInfo depth{};
    depth.sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO;
    depth.depthTestEnable = state.depth != DepthTest::none;
    depth.depthWriteEnable = state.depth == DepthTest::write;
    depth.depthCompareOp = VK_COMPARE_OP_LESS_OR_EQUAL;
    const std::vector<VkPipelineColorBlendAttachmentState> blends(pass.colors(), blend_state(state.blend));
    VkPipelineColorBlendStateCreateInfo blend{};
    blend.sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO;
    blend.attachmentCount = static_cast<std::uint32_t>(blends.size());
    blend.pAttachments = blends.data();
    const VkDynamicState changing[] = {VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
    VkPipelineDynamicStateCreateInfo dynamic{};
    dynamic.sType = VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO;
    dynamic.dynamicStateCount = 2;
    dynamic.pDynamicStates = changing;

    VkGraphicsPipelineCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO;
    info.stageCount = stages.count;
    info.pStages = stages.infos.data();
    info.pVertexInputState = &vertices;
    info.pInputAssemblyState = &assembly;
    info.pViewportState = &viewport;
    info.pRasterizationState = &raster;
    info.pMultisampleState = &multisample;
    info.pDepthStencilState = &depth;
    info.pColorBlendState = &blend;
    info.pDynamicState = &dynamic;
    info.layout = layout;
    info.renderPass = pass.handle();
    return device.vk().vkCreateGraphicsPipelines(device.handle(), device.pipeline_cache(), 1, &info, nullptr,
                                                 &pipeline);
}

}  // namespace

Result<GraphicsPipeline> GraphicsPipeline::create(const Device& device, const RenderPass& pass,
                                                  const GraphicsShaders& shaders, const GraphicsState& state,
                                                  std::span<const std::uint32_t> constants) {
    const std::string name(shaders.fragment.words.empty() ? shaders.vertex.name : shaders.fragment.name);
    auto interface = reflect(shaders.vertex, ShaderStage::vertex);
    if (!interface) return interface.errors();
    auto vertex = Module::create(device, shaders.vertex);
    if (!vertex) return vertex.errors();
    std::vector<Module> fragment;
    if (!shaders.fragment.words.empty()) {
        const auto other = reflect(shaders.fragment, ShaderStage::fragment);
        if (!other) return other.errors();
        *interface = join(std::move(*interface), *other);
        auto module = Module::create(device, shaders.fragment);
        if (!module) return module.errors();
        fragment.push_back(std::move(*module));
    }
    GraphicsPipeline self;
    self.device_ = &device;
    auto layout = PipelineLayout::create(device, *interface, stages, name);
    if (!layout) return layout.errors();
    self.layout_ = std::move(*layout);

    std::vector<VkSpecializationMapEntry> entries;
    for (std::uint32_t i = 0; i < constants.size(); ++i)
        entries.push_back({i, i * static_cast<std::uint32_t>(sizeof(std::uint32_t)), sizeof(std::uint32_t)});
    const VkSpecializationInfo specialization{static_cast<std::uint32_t>(entries.size()), entries.data(),
                                              constants.size_bytes(), constants.data()};
    const Stages used =
        stages_of(vertex->handle(), fragment.empty() ? VK_NULL_HANDLE : fragment.front().handle(), &specialization);
    const VkResult result = make_pipeline(device, pass, used, state, self.layout(), self.pipeline_);
    if (result != VK_SUCCESS) return device.error("to compile '" + name + "'", result);
    device.name(VK_OBJECT_TYPE_PIPELINE, reinterpret_cast<std::uint64_t>(self.pipeline_), name);
    return self;
}

GraphicsPipeline::~GraphicsPipeline() {
    if (pipeline_ != VK_NULL_HANDLE) device_->vk().vkDestroyPipeline(device_->handle(), pipeline_, nullptr);
}

void GraphicsPipeline::swap(GraphicsPipeline& other) {
    std::swap(device_, other.device_);
    std::swap(layout_, other.layout_);
    std::swap(pipeline_, other.pipeline_);
}

Result<DescriptorSet> DescriptorSet::create(const Device& device, VkDescriptorSetLayout layout,
                                            std::span<const BoundImage> images,
                                            std::span<const BoundUniform> uniforms) {
    DescriptorSet self;
    self.device_ = &device;
    const auto& vk = device.vk();
    std::vector<VkDescriptorPoolSize> sizes;
    const auto add_size = [&](VkDescriptorType type, std::size_t count) {
        if (count > 0) sizes.push_back({type, static_cast<std::uint32_t>(count)});
    };
    add_size(VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, images.size());
    add_size(VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC, uniforms.size());
    VkDescriptorPoolCreateInfo pool{};
    pool.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
    pool.maxSets = 1;
    pool.poolSizeCount = static_cast<std::uint32_t>(sizes.size());
    pool.pPoolSizes = sizes.data();
    VkResult result = vk.vkCreateDescriptorPool(device.handle(), &pool, nullptr, &self.pool_);
    VkDescriptorSetAllocateInfo allocate{};
    allocate.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
    allocate.descriptorPool = self.pool_;
    allocate.descriptorSetCount = 1;
    allocate.pSetLayouts = &layout;
    if (result == VK_SUCCESS) result = vk.vkAllocateDescriptorSets(device.handle(), &allocate, &self.set_);
    if (result != VK_SUCCESS) return device.error("to bind images and buffers", result);

    std::vector<VkDescriptorImageInfo> image_infos;
    std::vector<VkDescriptorBufferInfo> buffer_infos;
    image_infos.reserve(images.size());
    buffer_infos.reserve(uniforms.size());
    std::vector<VkWriteDescriptorSet> writes;
    const auto add_write = [&](std::uint32_t binding, VkDescriptorType type) -> VkWriteDescriptorSet& {
        VkWriteDescriptorSet& write = writes.emplace_back();
        write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
        write.dstSet = self.set_;
        write.dstBinding = binding;
        write.descriptorCount = 1;
        write.descriptorType = type;
        return write;
    };
    for (const BoundImage& image : images) {
        image_infos.push_back({image.sampler, image.view, image.layout});
        add_write(image.binding, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER).pImageInfo = &image_infos.back();
    }
    for (const BoundUniform& uniform : uniforms) {
        buffer_infos.push_back({uniform.buffer, 0, uniform.size});
        add_write(uniform.binding, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC).pBufferInfo = &buffer_infos.back();
    }
    vk.vkUpdateDescriptorSets(device.handle(), static_cast<std::uint32_t>(writes.size()), writes.data(), 0, nullptr);
    return self;
}

DescriptorSet::~DescriptorSet() {
    if (pool_ != VK_NULL_HANDLE) device_->vk().vkDestroyDescriptorPool(device_->handle(), pool_, nullptr);
}

void DescriptorSet::swap(DescriptorSet& other) {
    std::swap(device_, other.device_);
    std::swap(pool_, other.pool_);
    std::swap(set_, other.set_);
}

}  // namespace weft::gpu
