// Reads buffers as a host does: by their handles, with its own commands, after waiting for the timeline point of the
// buffers.
#pragma once

#include "gpu/vulkan.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <vector>

namespace weft {

class ReadBack {
  public:
    ReadBack(VkPhysicalDevice physical, VkDevice device, VkQueue queue, std::uint32_t family)
        : device_(device), queue_(queue) {
        volkLoadDeviceTable(&vk_, device);
        VkBufferCreateInfo buffer{};
        buffer.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
        buffer.size = bytes;
        buffer.usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT;
        check(vk_.vkCreateBuffer(device, &buffer, nullptr, &buffer_));
        VkMemoryRequirements needs{};
        vk_.vkGetBufferMemoryRequirements(device, buffer_, &needs);
        VkPhysicalDeviceMemoryProperties memory{};
        vkGetPhysicalDeviceMemoryProperties(physical, &memory);
        constexpr VkFlags seen = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
        VkMemoryAllocateInfo allocate{};
        allocate.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
        allocate.allocationSize = needs.size;
        while (!(needs.memoryTypeBits >> allocate.memoryTypeIndex & 1) ||
               (memory.memoryTypes[allocate.memoryTypeIndex].propertyFlags & seen) != seen)
            ++allocate.memoryTypeIndex;
        check(vk_.vkAllocateMemory(device, &allocate, nullptr, &memory_));
        check(vk_.vkBindBufferMemory(device, buffer_, memory_, 0));
        check(vk_.vkMapMemory(device, memory_, 0, VK_WHOLE_SIZE, 0, &mapped_));
        VkCommandPoolCreateInfo pool{};
        pool.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
        pool.queueFamilyIndex = family;
        check(vk_.vkCreateCommandPool(device, &pool, nullptr, &pool_));
        VkCommandBufferAllocateInfo commands{};
        commands.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
        commands.commandPool = pool_;
        commands.commandBufferCount = 1;
        check(vk_.vkAllocateCommandBuffers(device, &commands, &commands_));
    }
    ~ReadBack() {
        vk_.vkDestroyCommandPool(device_, pool_, nullptr);
        vk_.vkDestroyBuffer(device_, buffer_, nullptr);
        vk_.vkFreeMemory(device_, memory_, nullptr);
    }
    ReadBack(const ReadBack&) = delete;
    ReadBack& operator=(const ReadBack&) = delete;

    template <class T>
    std::vector<T> read(VkBuffer buffer, VkDeviceSize offset, std::size_t count, VkSemaphore ready,
                        std::uint64_t value) {
        std::vector<T> array(count);
        if (count == 0) return array;
        EXPECT_LE(count * sizeof(T), bytes);
        check(vk_.vkResetCommandPool(device_, pool_, 0));
        VkCommandBufferBeginInfo begin{};
        begin.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
        check(vk_.vkBeginCommandBuffer(commands_, &begin));
        const VkBufferCopy all{offset, 0, count * sizeof(T)};
        vk_.vkCmdCopyBuffer(commands_, buffer, buffer_, 1, &all);
        VkMemoryBarrier barrier{};
        barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
        barrier.srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
        barrier.dstAccessMask = VK_ACCESS_HOST_READ_BIT;
        vk_.vkCmdPipelineBarrier(commands_, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &barrier,
                                 0, nullptr, 0, nullptr);
        check(vk_.vkEndCommandBuffer(commands_));
        VkTimelineSemaphoreSubmitInfo values{};
        values.sType = VK_STRUCTURE_TYPE_TIMELINE_SEMAPHORE_SUBMIT_INFO;
        values.waitSemaphoreValueCount = 1;
        values.pWaitSemaphoreValues = &value;
        constexpr VkPipelineStageFlags stage = VK_PIPELINE_STAGE_TRANSFER_BIT;
        VkSubmitInfo submit{};
        submit.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
        submit.pNext = &values;
        submit.waitSemaphoreCount = 1;
        submit.pWaitSemaphores = &ready;
        submit.pWaitDstStageMask = &stage;
        submit.commandBufferCount = 1;
        submit.pCommandBuffers = &commands_;
        check(vk_.vkQueueSubmit(queue_, 1, &submit, VK_NULL_HANDLE));
        check(vk_.vkQueueWaitIdle(queue_));
        std::memcpy(array.data(), mapped_, count * sizeof(T));
        return array;
    }
    const VolkDeviceTable& vk() const { return vk_; }

  private:
    static constexpr VkDeviceSize bytes = 1 << 20;
    static void check(VkResult result) { EXPECT_EQ(result, VK_SUCCESS); }

    VkDevice device_;
    VkQueue queue_;
    VolkDeviceTable vk_{};
    VkBuffer buffer_ = VK_NULL_HANDLE;
    VkDeviceMemory memory_ = VK_NULL_HANDLE;
    void* mapped_ = nullptr;
    VkCommandPool pool_ = VK_NULL_HANDLE;
    VkCommandBuffer commands_ = VK_NULL_HANDLE;
};

}  // namespace weft
