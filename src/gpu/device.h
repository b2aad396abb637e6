// A logical device with one queue: memory, buffers, commands, pipelines come from it.
#pragma once

#include "gpu/instance.h"
#include "gpu/memory.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

namespace weft::gpu {

/// What a host shares. All of it outlives the device made of it.
struct HostDevice {
    VkPhysicalDevice physical = VK_NULL_HANDLE;
    VkDevice device = VK_NULL_HANDLE;  ///< made with bufferDeviceAddress, timelineSemaphore and hostQueryReset
    VkQueue queue = VK_NULL_HANDLE;    ///< runs compute, used from the thread that steps; without, the family's first
    std::uint32_t queue_family = 0;
    /// Called around every use of the queue, where other threads use it too; both or none.
    std::function<void()> lock_queue = {}, unlock_queue = {};
};

/// When a timeline semaphore has reached a value.
struct Moment {
    VkSemaphore semaphore = VK_NULL_HANDLE;
    std::uint64_t value = 0;
};

/// Beside moments, for what knows none: windows. Either may be missing.
struct BinarySemaphores {
    VkSemaphore wait = VK_NULL_HANDLE;    ///< before the work begins
    VkSemaphore signal = VK_NULL_HANDLE;  ///< when it is done
};

struct DeviceOptions {
    /// Where compiled pipelines are kept from run to run; empty: nowhere.
    std::filesystem::path pipeline_cache = {};
    /// Bytes of the device's and the host's memory that it takes at most, for those that share a GPU; 0: no limit.
    std::uint64_t memory_limit = 0;
    /// For tests: lets calls fail that a healthy device never does.
    std::function<void(VolkDeviceTable&)> intercept = {};
};

class Device {
  public:
    static Result<std::shared_ptr<Device>> create(std::shared_ptr<const Instance> instance, const DeviceInfo& info,
                                                  const DeviceOptions& options = {});
    static Result<std::shared_ptr<Device>> adopt(std::shared_ptr<const Instance> instance, const HostDevice& host,
                                                 const DeviceOptions& options = {});
    ~Device();
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    const DeviceInfo& info() const { return info_; }
    const DeviceLimits& limits() const { return info_.limits; }
    VkDevice handle() const { return device_; }
    const Instance& instance() const { return *instance_; }
    VkPhysicalDevice physical() const { return physical_; }
    VkQueue queue() const { return queue_; }
    std::uint32_t queue_family() const { return queue_family_; }
    /// Of a host's queue, if it has them.
    const std::function<void()>& lock_queue() const { return lock_queue_; }
    const std::function<void()>& unlock_queue() const { return unlock_queue_; }
    const VolkDeviceTable& vk() const { return vk_; }
    VkPipelineCache pipeline_cache() const { return pipeline_cache_; }
    Memory& memory() { return *memory_; }
    bool draws() const { return draws_; }                  ///< its queue draws too, not only computes
    bool presents() const { return presents_; }            ///< it can have a swapchain
    float most_anisotropy() const { return anisotropy_; }  ///< of samplers; 1: none

    /// Runs the commands after all that was submitted before, and not before `after`. Returns when they will be done:
    /// the value that `timeline()` reaches.
    Result<std::uint64_t> submit(VkCommandBuffer commands, Moment after = {}, BinarySemaphores binary = {});
    Result<Done> wait(std::uint64_t value);
    VkSemaphore timeline() const { return timeline_; }
    std::uint64_t submitted() const { return submitted_; }

    /// Names that validation layers and tools show; ignored without them.
    void name(VkObjectType type, std::uint64_t handle, const std::string& name) const;
    Error error(std::string_view doing, VkResult result) const { return vulkan_error(info_.name, doing, result); }
    /// Writes what was compiled since, if there is a file for it. Failing is no error: it is compiled again then.
    void save_pipeline_cache() const;

  private:
    Device() = default;
    Result<Done> open();
    Result<Done> finish(const DeviceOptions& options);
    Result<Done> look_at_queue();
    void load_pipeline_cache();

    std::shared_ptr<const Instance> instance_;
    DeviceInfo info_;
    VkPhysicalDevice physical_ = VK_NULL_HANDLE;
    VkDevice device_ = VK_NULL_HANDLE;
    bool owned_ = true;
    VkQueue queue_ = VK_NULL_HANDLE;
    std::uint32_t queue_family_ = 0;
    std::function<void()> lock_queue_, unlock_queue_;
    VolkDeviceTable vk_{};
    VkSemaphore timeline_ = VK_NULL_HANDLE;
    std::uint64_t submitted_ = 0;
    bool draws_ = false, presents_ = false;
    float anisotropy_ = 1;
    std::filesystem::path cache_file_;
    VkPipelineCache pipeline_cache_ = VK_NULL_HANDLE;
    std::unique_ptr<Memory> memory_;
};

}  // namespace weft::gpu
