#include "gpu/instance.h"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <iterator>

namespace weft::gpu {
namespace {

constexpr std::uint32_t needed_api = VK_API_VERSION_1_2;

std::array<std::uint32_t, 3> version_of(std::uint32_t api) {
    return {VK_API_VERSION_MAJOR(api), VK_API_VERSION_MINOR(api), VK_API_VERSION_PATCH(api)};
}

VKAPI_ATTR VkBool32 VKAPI_CALL report(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                                      const VkDebugUtilsMessengerCallbackDataEXT* data, void* user) {
    const auto& options = *static_cast<const InstanceOptions*>(user);
    if (options.on_message) {
        options.on_message(data->pMessage);
    } else {
        std::fprintf(stderr, "weft: Vulkan: %s\n", data->pMessage);
    }
    return VK_FALSE;
}

VkDebugUtilsMessengerCreateInfoEXT messenger_info(InstanceOptions& options) {
    VkDebugUtilsMessengerCreateInfoEXT info{};
    info.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT;
    info.messageSeverity =
        VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    info.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_GENERAL_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT |
                       VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT;
    info.pfnUserCallback = report;
    info.pUserData = &options;
    return info;
}

bool has_instance_extension(const char* layer, const char* name) {
    std::uint32_t count = 0;
    vkEnumerateInstanceExtensionProperties(layer, &count, nullptr);
    std::vector<VkExtensionProperties> list(count);
    vkEnumerateInstanceExtensionProperties(layer, &count, list.data());
    return std::ranges::any_of(list, [&](const auto& one) { return std::strcmp(one.extensionName, name) == 0; });
}

bool has_layer(const char* name) {
    std::uint32_t count = 0;
    vkEnumerateInstanceLayerProperties(&count, nullptr);
    std::vector<VkLayerProperties> list(count);
    vkEnumerateInstanceLayerProperties(&count, list.data());
    return std::ranges::any_of(list, [&](const auto& one) { return std::strcmp(one.layerName, name) == 0; });
}

Result<void> load(PFN_vkGetInstanceProcAddr functions = nullptr) {
    if (functions != nullptr) {
        volkInitializeCustom(functions);
    } else if (volkInitialize() != VK_SUCCESS) {
        return Error::of_machine(
            "Vulkan",
            "there is no loader (libvulkan.so.1) on this system; install libvulkan1 and a driver, or "
            "use --backend cpu");
    }
    if (volkGetInstanceVersion() < needed_api) {
        const auto v = version_of(volkGetInstanceVersion());
        return Error::of_machine("Vulkan", "the loader is of version " + std::to_string(v[0]) + "." +
                                               std::to_string(v[1]) + ", needed is 1.2; install a newer libvulkan1");
    }
    return {};
}

DeviceType type_of(VkPhysicalDeviceType type) {
    switch (type) {
        case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
            return DeviceType::discrete;
        case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
            return DeviceType::integrated;
        case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
            return DeviceType::virtual_gpu;
        case VK_PHYSICAL_DEVICE_TYPE_CPU:
            return DeviceType::cpu;
        default:
            return DeviceType::other;
    }
}

std::uint64_t memory_of(VkPhysicalDevice device) {
    VkPhysicalDeviceMemoryProperties memory{};
    vkGetPhysicalDeviceMemoryProperties(device, &memory);
    std::uint64_t most = 0;
    for (std::uint32_t i = 0; i < memory.memoryHeapCount; ++i) {
        if (memory.memoryHeaps[i].flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT)
            most = std::max<std::uint64_t>(most, memory.memoryHeaps[i].size);
    }
    return most;
}

DeviceInfo info_of(VkPhysicalDevice device, std::uint32_t index) {
    VkPhysicalDeviceProperties basic{};
    vkGetPhysicalDeviceProperties(device, &basic);
    DeviceInfo info;
    info.index = index;
    info.name = basic.deviceName;
    info.type = type_of(basic.deviceType);
    info.api = version_of(basic.apiVersion);
    info.memory = memory_of(device);
    if (basic.apiVersion < needed_api) {
        info.driver = "unknown driver";
        info.missing.push_back("Vulkan 1.2");
        return info;
    }

    VkPhysicalDeviceDriverProperties driver{};
    driver.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES;
    VkPhysicalDeviceSubgroupProperties subgroup{};
    subgroup.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_PROPERTIES;
    subgroup.pNext = &driver;
    VkPhysicalDeviceMaintenance3Properties allocation{};
    allocation.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_3_PROPERTIES;
    allocation.pNext = &subgroup;
    VkPhysicalDeviceProperties2 properties{};
    properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
    properties.pNext = &allocation;
    vkGetPhysicalDeviceProperties2(device, &properties);
    info.driver = std::string(driver.driverName) + (driver.driverInfo[0] ? " " : "") + driver.driverInfo;

    const VkPhysicalDeviceLimits& limits = basic.limits;
    DeviceLimits& mine = info.limits;
    mine.shared_memory = limits.maxComputeSharedMemorySize;
    mine.workgroup_invocations = limits.maxComputeWorkGroupInvocations;
    std::copy_n(limits.maxComputeWorkGroupSize, 3, mine.workgroup_size.begin());
    std::copy_n(limits.maxComputeWorkGroupCount, 3, mine.workgroup_count.begin());
    mine.push_constants = limits.maxPushConstantsSize;
    mine.descriptor_sets = limits.maxBoundDescriptorSets;
    mine.subgroup_size = subgroup.subgroupSize;
    mine.largest_allocation = allocation.maxMemoryAllocationSize;
    mine.largest_storage_range = limits.maxStorageBufferRange;
    mine.timestamp_period = static_cast<double>(limits.timestampPeriod);

    VkPhysicalDeviceVulkan12Features features{};
    features.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES;
    VkPhysicalDeviceFeatures2 all{};
    all.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2;
    all.pNext = &features;
    vkGetPhysicalDeviceFeatures2(device, &all);
    if (!features.bufferDeviceAddress) info.missing.push_back("bufferDeviceAddress");
    if (!features.timelineSemaphore) info.missing.push_back("timelineSemaphore");
    if (!features.hostQueryReset) info.missing.push_back("hostQueryReset");
    return info;
}

// Keeps the drivers loaded until the process ends. Otherwise the loader unloads them with the last instance and loads
// them again for the next one, and after some times NVIDIA's driver (580) finds no room left for its thread-local
// storage: "cannot allocate memory in static TLS block".
void keep_drivers_loaded() {
    static const VkInstance kept = [] {
        VkInstanceCreateInfo info{};
        info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
        VkInstance instance = VK_NULL_HANDLE;
        return vkCreateInstance(&info, nullptr, &instance) == VK_SUCCESS ? instance : VK_NULL_HANDLE;
    }();
    (void)kept;
}

}  // namespace

Result<std::shared_ptr<const Instance>> Instance::create(InstanceOptions options) {
    const auto lock = lock_loader();
    if (auto loaded = load(); !loaded) return loaded.errors();
    constexpr const char* layer = "VK_LAYER_KHRONOS_validation";
    if (options.validation && !has_layer(layer)) {
        return Error::of_machine("Vulkan",
                                 std::string("there is no layer ") + layer + "; install vulkan-validationlayers");
    }
    keep_drivers_loaded();
    auto self = std::shared_ptr<Instance>(new Instance);
    self->functions_ = vkGetInstanceProcAddr;
    self->options_ = std::move(options);
    const bool validation = self->options_.validation;

    VkApplicationInfo application{};
    application.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
    application.pApplicationName = "weft";
    application.apiVersion = VK_API_VERSION_1_2;

    std::vector<const char*> extensions, layers;
    const bool debug_utils = has_instance_extension(nullptr, VK_EXT_DEBUG_UTILS_EXTENSION_NAME) ||
                             (validation && has_instance_extension(layer, VK_EXT_DEBUG_UTILS_EXTENSION_NAME));
    if (debug_utils) extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    // The loader lists drivers that run on top of other interfaces (Metal) only with this extension.
    VkInstanceCreateFlags flags = 0;
    if (has_instance_extension(nullptr, VK_KHR_PORTABILITY_ENUMERATION_EXTENSION_NAME)) {
        extensions.push_back(VK_KHR_PORTABILITY_ENUMERATION_EXTENSION_NAME);
        flags |= VK_INSTANCE_CREATE_ENUMERATE_PORTABILITY_BIT_KHR;
    }
    if (validation) layers.push_back(layer);
    const auto& surface = self->options_.surface_extensions;
    self->surfaces_ = !surface.empty() && std::ranges::all_of(surface, [](const std::string& name) {
        return has_instance_extension(nullptr, name.c_str());
    });
    if (self->surfaces_) std::ranges::transform(surface, std::back_inserter(extensions), &std::string::c_str);

    VkDebugUtilsMessengerCreateInfoEXT messages = messenger_info(self->options_);
    VkValidationFeaturesEXT features{};
    features.sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT;
    features.pNext = debug_utils ? &messages : nullptr;
    const VkValidationFeatureEnableEXT enabled[] = {VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT};
    features.enabledValidationFeatureCount = 1;
    features.pEnabledValidationFeatures = enabled;

    VkInstanceCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
    info.flags = flags;
    info.pApplicationInfo = &application;
    info.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
    info.ppEnabledExtensionNames = extensions.data();
    info.enabledLayerCount = static_cast<std::uint32_t>(layers.size());
    info.ppEnabledLayerNames = layers.data();
    if (validation) info.pNext = &features;
    if (const VkResult result = vkCreateInstance(&info, nullptr, &self->instance_); result != VK_SUCCESS) {
        if (result == VK_ERROR_INCOMPATIBLE_DRIVER) {
            return Error::of_machine("Vulkan",
                                     "there is no driver; install that of the GPU, or mesa-vulkan-drivers for one in "
                                     "software, or use --backend cpu");
        }
        return vulkan_error("Vulkan", "to create an instance", result);
    }
    volkLoadInstanceOnly(self->instance_);
    if (debug_utils) {
        self->set_name_ = vkSetDebugUtilsObjectNameEXT;
        self->destroy_messenger_ = vkDestroyDebugUtilsMessengerEXT;
        if (validation) vkCreateDebugUtilsMessengerEXT(self->instance_, &messages, nullptr, &self->messenger_);
    }
    if (auto found = self->find_devices(); !found) return found.errors();
    return std::shared_ptr<const Instance>(std::move(self));
}

Result<std::shared_ptr<const Instance>> Instance::adopt(VkInstance instance, PFN_vkGetInstanceProcAddr functions) {
    if (instance == VK_NULL_HANDLE) return Error{"Vulkan", "VulkanHost::instance is null"};
    const auto lock = lock_loader();
    if (auto loaded = load(functions); !loaded) return loaded.errors();
    auto self = std::shared_ptr<Instance>(new Instance);
    self->functions_ = vkGetInstanceProcAddr;
    self->instance_ = instance;
    self->owned_ = false;
    volkLoadInstanceOnly(instance);
    if (vkGetPhysicalDeviceProperties2 == nullptr)
        return Error{"Vulkan",
                     "the instance was created for a version older than 1.2; set VkApplicationInfo::apiVersion and "
                     "VulkanHost::api_version to 1.2 or later"};
    if (auto found = self->find_devices(); !found) return found.errors();
    return std::shared_ptr<const Instance>(std::move(self));
}

Instance::~Instance() {
    if (!owned_ || instance_ == VK_NULL_HANDLE) return;
    const auto lock = lock_loader();
    take_functions();
    if (messenger_ != VK_NULL_HANDLE) destroy_messenger_(instance_, messenger_, nullptr);
    vkDestroyInstance(instance_, nullptr);
}

void Instance::take_functions() const {
    volkInitializeCustom(functions_);
    volkLoadInstanceOnly(instance_);
}

Result<void> Instance::find_devices() {
    std::uint32_t count = 0;
    VkResult result = vkEnumeratePhysicalDevices(instance_, &count, nullptr);
    physical_.resize(count);
    if (result == VK_SUCCESS) result = vkEnumeratePhysicalDevices(instance_, &count, physical_.data());
    if (result != VK_SUCCESS && result != VK_INCOMPLETE)  // incomplete: a device appeared after the count
        return vulkan_error("Vulkan", "to list the devices", result);
    physical_.resize(count);
    for (std::uint32_t i = 0; i < count; ++i) infos_.push_back(info_of(physical_[i], i));
    return {};
}

}  // namespace weft::gpu
