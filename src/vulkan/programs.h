// Pipelines of the shaders, made when they are first needed and compiled when they are first recorded.
#pragma once

#include "gpu/device.h"
#include "gpu/pipeline.h"

#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace weft::vulkan {

class Programs {
  public:
    explicit Programs(const gpu::Device& device) : device_(device) {}

    const gpu::Device& device() const { return device_; }

    Result<const gpu::Pipeline*> get(std::string_view name);
    /// `constants`: values of the specialization constants, the workgroup's size first.
    Result<const gpu::Pipeline*> get(std::string_view name, std::span<const std::uint32_t> constants);

  private:
    const gpu::Device& device_;
    std::map<std::string, std::unique_ptr<gpu::Pipeline>, std::less<>> made_;
};

}  // namespace weft::vulkan
