// The Vulkan loader, an instance, and the devices that there are.
#pragma once

#include "gpu/device_info.h"
#include "gpu/vulkan.h"

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace weft::gpu {

struct InstanceOptions {
    /// Validation layers, checks of synchronization among them: slow, for tests. Fails if they are not installed.
    bool validation = false;
    /// Extensions for windows, where there are all of them (has_surfaces()); those that a window library asks for.
    std::vector<std::string> surface_extensions = {};
    /// What layers and drivers complain about, from any thread. Without it, on stderr.
    std::function<void(std::string_view)> on_message = {};
};

class Instance {
  public:
    /// Fails without a loader (the system has no Vulkan at all) and where it is older than 1.2.
    static Result<std::shared_ptr<const Instance>> create(InstanceOptions options = {});
    /// A host's own, made for Vulkan 1.2 or later, which outlives this one. `functions` is where it came from; without,
    /// the system's loader.
    static Result<std::shared_ptr<const Instance>> adopt(VkInstance instance,
                                                         PFN_vkGetInstanceProcAddr functions = nullptr);
    ~Instance();
    Instance(const Instance&) = delete;
    Instance& operator=(const Instance&) = delete;

    VkInstance handle() const { return instance_; }
    PFN_vkGetInstanceProcAddr functions() const { return functions_; }
    /// Makes volk's variables those of this instance, for whoever holds lock_loader().
    void take_functions() const;
    /// Names objects for layers and tools; nullptr where nobody would read them.
    PFN_vkSetDebugUtilsObjectNameEXT set_name() const { return set_name_; }
    bool has_surfaces() const { return surfaces_; }
    const std::vector<DeviceInfo>& devices() const { return infos_; }
    VkPhysicalDevice physical(const DeviceInfo& info) const { return physical_[info.index]; }

  private:
    Instance() = default;
    Result<Done> find_devices();

    InstanceOptions options_;
    VkInstance instance_ = VK_NULL_HANDLE;
    PFN_vkGetInstanceProcAddr functions_ = nullptr;
    VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
    bool owned_ = true, surfaces_ = false;
    // Of this instance: volk's are those of the last one made, which may be without the extension.
    PFN_vkDestroyDebugUtilsMessengerEXT destroy_messenger_ = nullptr;
    PFN_vkSetDebugUtilsObjectNameEXT set_name_ = nullptr;
    std::vector<VkPhysicalDevice> physical_;
    std::vector<DeviceInfo> infos_;
};

}  // namespace weft::gpu
