// A pipeline of a vertex and a fragment shader. The vertex shader reads vertices from storage buffers by itself.
#pragma once

#include "gpu/pipeline_layout.h"
#include "gpu/render_pass.h"
#include "gpu/spirv.h"

#include <span>

namespace weft::gpu {

enum class Blend {
    none,
    over,  ///< by the fragment's alpha, which accumulates
    add,
};

enum class DepthTest {
    none,
    read,   ///< hidden fragments are not drawn
    write,  ///< likewise, and fragments write their depth
};

struct GraphicsState {
    VkCullModeFlags cull = VK_CULL_MODE_NONE;  ///< front sides are counterclockwise in the image
    DepthTest depth = DepthTest::none;
    Blend blend = Blend::none;
    float depth_bias = 0, slope_bias = 0;
};

struct GraphicsShaders {
    Shader vertex, fragment;  ///< without words of a fragment shader, only depth is drawn
};

class GraphicsPipeline {
  public:
    /// `constants`: values of both shaders' specialization constants with ids 0, 1, 2, …
    static Result<GraphicsPipeline> create(const Device& device, const RenderPass& pass, const GraphicsShaders& shaders,
                                           const GraphicsState& state, std::span<const std::uint32_t> constants = {});
    GraphicsPipeline() = default;
    GraphicsPipeline(GraphicsPipeline&& other) noexcept { swap(other); }
    GraphicsPipeline& operator=(GraphicsPipeline&& other) noexcept {
        GraphicsPipeline(std::move(other)).swap(*this);
        return *this;
    }
    ~GraphicsPipeline();

    VkPipeline handle() const { return pipeline_; }
    VkPipelineLayout layout() const { return layout_.handle(); }
    /// Layout of a descriptor set. Pipelines whose shaders declare the same set can share descriptor sets.
    VkDescriptorSetLayout set_layout(std::uint32_t set) const { return layout_.sets()[set]; }

    static constexpr VkShaderStageFlags stages = VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;

  private:
    void swap(GraphicsPipeline& other);

    const Device* device_ = nullptr;
    PipelineLayout layout_;
    VkPipeline pipeline_ = VK_NULL_HANDLE;
};

struct BoundImage {
    std::uint32_t binding = 0;
    VkImageView view = VK_NULL_HANDLE;
    VkSampler sampler = VK_NULL_HANDLE;
    VkImageLayout layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
};

/// A uniform buffer, of which the shaders read `size` bytes from an offset that each draw command chooses.
struct BoundUniform {
    std::uint32_t binding = 0;
    VkBuffer buffer = VK_NULL_HANDLE;
    std::uint64_t size = 0;
};

/// Images and uniform buffers for the shaders. They must not be replaced while the set is in use.
class DescriptorSet {
  public:
    static Result<DescriptorSet> create(const Device& device, VkDescriptorSetLayout layout,
                                        std::span<const BoundImage> images,
                                        std::span<const BoundUniform> uniforms = {});
    DescriptorSet() = default;
    DescriptorSet(DescriptorSet&& other) noexcept { swap(other); }
    DescriptorSet& operator=(DescriptorSet&& other) noexcept {
        DescriptorSet(std::move(other)).swap(*this);
        return *this;
    }
    ~DescriptorSet();
    VkDescriptorSet handle() const { return set_; }

  private:
    void swap(DescriptorSet& other);

    const Device* device_ = nullptr;
    VkDescriptorPool pool_ = VK_NULL_HANDLE;
    VkDescriptorSet set_ = VK_NULL_HANDLE;
};

}  // namespace weft::gpu
