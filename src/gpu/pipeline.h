// A compute pipeline. Its push constants and bindings are read from the shader itself.
#pragma once

#include "gpu/pipeline_layout.h"
#include "gpu/spirv.h"
#include "gpu/vulkan.h"

#include <memory>
#include <span>
#include <vector>

namespace weft::gpu {

class Device;

class Pipeline {
  public:
    /// `constants`: values of the shader's specialization constants, those with ids 0, 1, 2, …
    static Result<Pipeline> create(const Device& device, const Shader& shader,
                                   std::span<const std::uint32_t> constants = {});
    /// The same without compiling, which takes some drivers seconds. The shader's words must outlive the pipeline.
    static Result<Pipeline> prepare(const Device& device, const Shader& shader,
                                    std::span<const std::uint32_t> constants = {});
    /// Compiles it if it is not compiled yet. Several pipelines may be compiled at the same time, but not one twice.
    Result<void> compile() const;
    bool compiled() const { return pipeline_ != VK_NULL_HANDLE; }
    Pipeline(Pipeline&& other) noexcept { swap(other); }
    Pipeline& operator=(Pipeline&& other) noexcept {
        Pipeline(std::move(other)).swap(*this);
        return *this;
    }
    ~Pipeline();

    VkPipeline handle() const { return pipeline_; }  ///< null until it is compiled
    VkPipelineLayout layout() const { return layout_.handle(); }
    std::uint32_t push_constants() const { return interface_.push_constants; }
    std::uint32_t workgroup() const { return interface_.workgroup[0]; }  ///< invocations along x

  private:
    Pipeline() = default;
    void swap(Pipeline& other);

    const Device* device_ = nullptr;
    Shader shader_;
    std::vector<std::uint32_t> constants_;
    ShaderInterface interface_;
    PipelineLayout layout_;
    mutable VkPipeline pipeline_ = VK_NULL_HANDLE;
};

/// Compiles those that are not compiled yet, several at a time. A pipeline may be named more than once.
Result<void> compile_together(std::span<const Pipeline* const> pipelines);

}  // namespace weft::gpu
