// The Vulkan loader, an instance, and its list of devices.
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
    /// Validation layers, including synchronization checks: slow, for tests. Fails if they are not installed.
    bool validation = false;
    /// Extensions that a window library asks for. They are enabled only if all are available (has_surfaces()).
    std::vector<std::string> surface_extensions = {};
    /// Gets messages of layers and drivers, from any thread. If empty, they go to stderr.
    std::function<void(std::string_view)> on_message = {};
};

class Instance {
  public:
    /// Fails without a loader (the system has no Vulkan) and with a loader older than 1.2.
    static Result<std::shared_ptr<const Instance>> create(InstanceOptions options = {});
    /// Uses a host's instance, made for Vulkan 1.2 or later, which must outlive this one. `functions`: the host's
    /// vkGetInstanceProcAddr; null: that of the system's loader.
    static Result<std::shared_ptr<const Instance>> adopt(VkInstance instance,
                                                         PFN_vkGetInstanceProcAddr functions = nullptr);
    ~Instance();
    Instance(const Instance&) = delete;
    Instance& operator=(const Instance&) = delete;

    VkInstance handle() const { return instance_; }
    PFN_vkGetInstanceProcAddr functions() const { return functions_; }
    /// Loads the functions of this instance into volk's variables. The caller must hold lock_loader().
    void take_functions() const;
    /// Names objects for layers and tools; null without them.
    PFN_vkSetDebugUtilsObjectNameEXT set_name() const { return set_name_; }
    bool has_surfaces() const { return surfaces_; }
    const std::vector<DeviceInfo>& devices() const { return infos_; }
    VkPhysicalDevice physical(const DeviceInfo& info) const { return physical_[info.index]; }

  private:
    Instance() = default;
    Result<void> find_devices();

    InstanceOptions options_;
    VkInstance instance_ = VK_NULL_HANDLE;
    PFN_vkGetInstanceProcAddr functions_ = nullptr;
    VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
    bool owned_ = true, surfaces_ = false;
    // Functions of this instance. volk holds those of the last instance made, which may lack the extension.
    PFN_vkDestroyDebugUtilsMessengerEXT destroy_messenger_ = nullptr;
    PFN_vkSetDebugUtilsObjectNameEXT set_name_ = nullptr;
    std::vector<VkPhysicalDevice> physical_;
    std::vector<DeviceInfo> infos_;
};

}  // namespace weft::gpu
