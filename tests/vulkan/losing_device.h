// A device that is lost after a given number of submits.
#pragma once

#include "vulkan/vulkan_backend.h"

#include <volk.h>

#include <limits>

namespace weft::losing_device {

inline constexpr int never = std::numeric_limits<int>::max();
inline int submits_left = never;
inline PFN_vkQueueSubmit healthy_submit = nullptr;

inline VkResult VKAPI_CALL submit(VkQueue queue, std::uint32_t count, const VkSubmitInfo* info, VkFence fence) {
    if (submits_left <= 0) return VK_ERROR_DEVICE_LOST;
    if (submits_left != never) --submits_left;
    return healthy_submit(queue, count, info, fence);
}

/// For VulkanOptions::intercept. The device is not lost at first.
inline void intercept(VolkDeviceTable& table) {
    submits_left = never;
    healthy_submit = table.vkQueueSubmit;
    table.vkQueueSubmit = submit;
}

}  // namespace weft::losing_device
