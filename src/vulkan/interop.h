// Access to the device of the Vulkan backend and to the drawn surfaces of its cloths, for renderers on the same device.
// A Backend that runs on Vulkan can be cast to VulkanInterop.
#pragma once

#include "gpu/device.h"
#include "gpu/surface_buffers.h"
#include "vulkan/vulkan_backend.h"

#include <memory>

namespace weft {

class VulkanInterop {
  public:
    virtual ~VulkanInterop() = default;

    virtual const std::shared_ptr<gpu::Device>& shared_device() const = 0;
    /// The drawn surface of the cloth's current state; vulkan/surface/drawn_surface.h describes the synchronization.
    /// The buffers are valid until the cloth is removed or gets another model.
    virtual Result<gpu::SurfaceBuffers> surface(ClothHandle cloth, gpu::Moment before = {}) = 0;
};

/// Creates a device as make_vulkan_backend(options) does. Uses only the options about the device.
Result<std::shared_ptr<gpu::Device>> make_vulkan_device(const VulkanOptions& options);
/// A backend on an existing device. Ignores the options about the device.
Result<std::unique_ptr<Backend>> make_vulkan_backend(std::shared_ptr<gpu::Device> device, const VulkanOptions& options);
/// A backend on the device of a host application.
Result<std::unique_ptr<Backend>> make_vulkan_backend(std::shared_ptr<const gpu::Instance> instance,
                                                     const gpu::HostDevice& host, const VulkanOptions& options);

}  // namespace weft
