// How the Vulkan backend opens a device.
#pragma once

#include "gpu/device.h"
#include "vulkan/vulkan_backend.h"

namespace weft::vulkan {

/// With a pipeline cache of its own for each device and driver, if the cache folder is used.
gpu::DeviceOptions device_options(const gpu::DeviceInfo& info, const VulkanOptions& options);

}  // namespace weft::vulkan
