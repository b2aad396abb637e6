// A device as a host application creates it.
#pragma once

#include "gpu/vulkan.h"

#include <gtest/gtest.h>

namespace weft::gpu {

/// With a queue of the first family and all features that weft needs.
inline VkDevice make_host_device(VkPhysicalDevice physical) {
    const float priority = 1;
    VkDeviceQueueCreateInfo queue{};
    queue.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
    queue.queueCount = 1;
    queue.pQueuePriorities = &priority;
    VkPhysicalDeviceVulkan12Features features{};
    features.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES;
    features.bufferDeviceAddress = features.timelineSemaphore = features.hostQueryReset = VK_TRUE;
    VkDeviceCreateInfo create{};
    create.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
    create.pNext = &features;
    create.queueCreateInfoCount = 1;
    create.pQueueCreateInfos = &queue;
    VkDevice device = VK_NULL_HANDLE;
    EXPECT_EQ(vkCreateDevice(physical, &create, nullptr, &device), VK_SUCCESS);
    return device;
}

}  // namespace weft::gpu
