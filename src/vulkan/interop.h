// What the Vulkan backend has for others on the same device: itself, and the drawn surfaces of its cloths. A Backend
// that runs on Vulkan can be cast to it.
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
    /// The drawn surface of the cloth as it is now; vulkan/surface/drawn_surface.h says what is written when. Buffers
    /// are those of the cloth until it is removed or has another model: nobody may read them then.
    virtual Result<gpu::SurfaceBuffers> surface(ClothHandle cloth, gpu::Moment before = {}) = 0;
};

/// A device as make_vulkan_backend() makes one for itself; of the options, those that choose one count.
Result<std::shared_ptr<gpu::Device>> make_vulkan_device(const VulkanOptions& options);
/// On a device that is there already. Of the options, those that choose one do not count.
Result<std::unique_ptr<Backend>> make_vulkan_backend(std::shared_ptr<gpu::Device> device, const VulkanOptions& options);
/// On a host's.
Result<std::unique_ptr<Backend>> make_vulkan_backend(std::shared_ptr<const gpu::Instance> instance,
                                                     const gpu::HostDevice& host, const VulkanOptions& options);

}  // namespace weft
