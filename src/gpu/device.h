// A logical device with one queue. Creates memory, buffers, commands and pipelines.
#pragma once

#include "base/cache_file.h"
#include "gpu/instance.h"
#include "gpu/memory.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

namespace weft::gpu {

/// A host application's device. All of it must outlive the Device made from it.
struct HostDevice {
    VkPhysicalDevice physical = VK_NULL_HANDLE;
    VkDevice device = VK_NULL_HANDLE;  ///< made with bufferDeviceAddress, timelineSemaphore and hostQueryReset
    VkQueue queue = VK_NULL_HANDLE;    ///< runs compute, used by the stepping thread; null: the family's first queue
    std::uint32_t queue_family = 0;
    /// Called around every use of the queue, if other threads use it too. Set both or none.
    std::function<void()> lock_queue = {}, unlock_queue = {};
};

/// The time at which a timeline semaphore reaches a value.
struct Moment {
    VkSemaphore semaphore = VK_NULL_HANDLE;
    std::uint64_t value = 0;
};

/// Semaphores for presentation in windows, which does not support timeline semaphores. Either may be null.
struct BinarySemaphores {
    VkSemaphore wait = VK_NULL_HANDLE;    ///< before the work begins
    VkSemaphore signal = VK_NULL_HANDLE;  ///< when it is done
};

/// Drivers check only the header of a pipeline cache, so its file must detect damage.
inline constexpr CacheFormat pipeline_cache_format = "weft-pc1";

struct DeviceOptions {
    /// File that keeps compiled pipelines from run to run; empty: none.
    std::filesystem::path pipeline_cache = {};
    /// Largest amount of device and host memory to allocate, in bytes, for programs that share a GPU; 0: no limit.
    std::uint64_t memory_limit = 0;
    /// For tests: replaces functions of the device, so that calls can fail.
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
    /// Lock functions of a host's queue; may be empty.
    const std::function<void()>& lock_queue() const { return lock_queue_; }
    const std::function<void()>& unlock_queue() const { return unlock_queue_; }
    const VolkDeviceTable& vk() const { return vk_; }
    VkPipelineCache pipeline_cache() const { return pipeline_cache_; }
    Memory& memory() { return *memory_; }
    bool draws() const { return draws_; }                  ///< its queue supports drawing, not only compute
    bool presents() const { return presents_; }            ///< supports swapchains
    float most_anisotropy() const { return anisotropy_; }  ///< of samplers; 1: none

    /// Runs the commands after all earlier submissions and after `after`. Returns the value that `timeline()` reaches
    /// when they are done.
    Result<std::uint64_t> submit(VkCommandBuffer commands, Moment after = {}, BinarySemaphores binary = {});
    Result<void> wait(std::uint64_t value);
    VkSemaphore timeline() const { return timeline_; }
    std::uint64_t submitted() const { return submitted_; }

    /// Sets a name that validation layers and tools show; ignored without them.
    void name(VkObjectType type, std::uint64_t handle, const std::string& name) const;
    Error error(std::string_view doing, VkResult result) const { return vulkan_error(info_.name, doing, result); }
    /// Writes the compiled pipelines to the cache file, if there is one. A failure is no error: the next run compiles
    /// them again.
    void save_pipeline_cache() const;

  private:
    Device() = default;
    Result<void> open();
    Result<void> finish(const DeviceOptions& options);
    Result<void> look_at_queue();
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
