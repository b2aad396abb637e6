// A device that counts recorded commands and submits.
#pragma once

#include "vulkan/vulkan_backend.h"

#include <volk.h>

#include <atomic>

namespace weft::counting_device {

inline std::atomic<int> dispatches = 0, submits = 0;
inline PFN_vkCmdDispatch real_dispatch = nullptr;
inline PFN_vkQueueSubmit real_submit = nullptr;

inline void VKAPI_CALL dispatch(VkCommandBuffer commands, std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    ++dispatches;
    real_dispatch(commands, x, y, z);
}

inline VkResult VKAPI_CALL submit(VkQueue queue, std::uint32_t count, const VkSubmitInfo* info, VkFence fence) {
    ++submits;
    return real_submit(queue, count, info, fence);
}

/// For VulkanOptions::intercept.
inline void intercept(VolkDeviceTable& table) {
    real_dispatch = table.vkCmdDispatch;
    table.vkCmdDispatch = dispatch;
    real_submit = table.vkQueueSubmit;
    table.vkQueueSubmit = submit;
}

}  // namespace weft::counting_device
