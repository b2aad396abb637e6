#include "gpu/device.h"

#include "base/flush_subnormals.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <optional>

namespace weft::gpu {
namespace {

std::vector<VkQueueFamilyProperties> queue_families(VkPhysicalDevice physical) {
    std::uint32_t count = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, families.data());
    return families;
}

// Prefers a family that also draws, because a renderer needs both on the same queue.
std::optional<std::uint32_t> find_queue_family(VkPhysicalDevice physical) {
    const auto families = queue_families(physical);
    for (const VkQueueFlags wanted :
         {VkQueueFlags{VK_QUEUE_COMPUTE_BIT | VK_QUEUE_GRAPHICS_BIT}, VkQueueFlags{VK_QUEUE_COMPUTE_BIT}}) {
        for (std::uint32_t i = 0; i < families.size(); ++i) {
            if ((families[i].queueFlags & wanted) == wanted) return i;
        }
    }
    return std::nullopt;
}

bool has_device_extension(VkPhysicalDevice physical, const char* name) {
    std::uint32_t count = 0;
    vkEnumerateDeviceExtensionProperties(physical, nullptr, &count, nullptr);
    std::vector<VkExtensionProperties> list(count);
    vkEnumerateDeviceExtensionProperties(physical, nullptr, &count, list.data());
    return std::ranges::any_of(list, [&](const auto& one) { return std::strcmp(one.extensionName, name) == 0; });
}

}  // namespace

Result<std::shared_ptr<Device>> Device::create(std::shared_ptr<const Instance> instance, const DeviceInfo& info,
                                               const DeviceOptions& options) {
    const auto lock = lock_loader();
    instance->take_functions();
    auto self = std::shared_ptr<Device>(new Device);
    self->instance_ = std::move(instance);
    self->info_ = info;
    self->physical_ = self->instance_->physical(info);
    if (auto opened = self->open(); !opened) return opened.errors();
    if (auto finished = self->finish(options); !finished) return finished.errors();
    return self;
}

Result<std::shared_ptr<Device>> Device::adopt(std::shared_ptr<const Instance> instance, const HostDevice& host,
                                              const DeviceOptions& options) {
    const auto lock = lock_loader();
    instance->take_functions();
    const auto& known = instance->devices();
    const auto it =
        std::ranges::find_if(known, [&](const DeviceInfo& one) { return instance->physical(one) == host.physical; });
    if (it == known.end()) return Error{"Vulkan", "the physical device does not belong to the instance"};
    if (!it->usable()) return Error::of_machine(it->name, "lacks " + it->missing.front());
    if (host.device == VK_NULL_HANDLE) return Error{it->name, "VulkanHost::device is null"};
    auto self = std::shared_ptr<Device>(new Device);
    self->owned_ = false;
    self->info_ = *it;
    self->physical_ = host.physical;
    self->device_ = host.device;
    self->queue_ = host.queue;
    self->queue_family_ = host.queue_family;
    self->lock_queue_ = host.lock_queue;
    self->unlock_queue_ = host.unlock_queue;
    self->instance_ = std::move(instance);
    if (auto finished = self->finish(options); !finished) return finished.errors();
    return self;
}

Result<void> Device::open() {
    const auto family = find_queue_family(physical_);
    if (!family) return Error::of_machine(info_.name, "has no queue family for compute");
    queue_family_ = *family;

    const float priority = 1;
    VkDeviceQueueCreateInfo queue{};
    queue.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
    queue.queueFamilyIndex = queue_family_;
    queue.queueCount = 1;
    queue.pQueuePriorities = &priority;
    VkPhysicalDeviceVulkan12Features features{};
    features.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES;
    features.bufferDeviceAddress = VK_TRUE;
    features.timelineSemaphore = VK_TRUE;
    features.hostQueryReset = VK_TRUE;
    std::vector<const char*> extensions;
    constexpr const char* subset = "VK_KHR_portability_subset";  // must be enabled if the device has it
    if (has_device_extension(physical_, subset)) extensions.push_back(subset);
    // Windows, if the instance and the device support them.
    presents_ = instance_->has_surfaces() && has_device_extension(physical_, VK_KHR_SWAPCHAIN_EXTENSION_NAME);
    if (presents_) extensions.push_back(VK_KHR_SWAPCHAIN_EXTENSION_NAME);
    VkPhysicalDeviceFeatures can{}, wanted{};
    vkGetPhysicalDeviceFeatures(physical_, &can);
    // Software devices visit all texels of a footprint. A pattern that repeats far away has millions of them.
    if (info_.type == DeviceType::cpu) can.samplerAnisotropy = VK_FALSE;
    wanted.samplerAnisotropy = can.samplerAnisotropy;
    VkDeviceCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
    info.pNext = &features;
    info.queueCreateInfoCount = 1;
    info.pQueueCreateInfos = &queue;
    info.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
    info.ppEnabledExtensionNames = extensions.data();
    info.pEnabledFeatures = &wanted;
    if (can.samplerAnisotropy) {
        VkPhysicalDeviceProperties properties{};
        vkGetPhysicalDeviceProperties(physical_, &properties);
        anisotropy_ = properties.limits.maxSamplerAnisotropy;
    }
    // The threads of a software device inherit the modes of this one. GPUs are not affected.
    const FlushSubnormals flush;
    if (const VkResult result = vkCreateDevice(physical_, &info, nullptr, &device_); result != VK_SUCCESS) {
        device_ = VK_NULL_HANDLE;
        return error("to open the device", result);
    }
    return {};
}

Result<void> Device::finish(const DeviceOptions& options) {
    volkLoadDeviceTable(&vk_, device_);
    if (options.intercept) options.intercept(vk_);
    if (auto looked = look_at_queue(); !looked) return looked;
    if (queue_ == VK_NULL_HANDLE) vk_.vkGetDeviceQueue(device_, queue_family_, 0, &queue_);
    VkSemaphoreTypeCreateInfo type{};
    type.sType = VK_STRUCTURE_TYPE_SEMAPHORE_TYPE_CREATE_INFO;
    type.semaphoreType = VK_SEMAPHORE_TYPE_TIMELINE;
    VkSemaphoreCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO;
    info.pNext = &type;
    if (const VkResult result = vk_.vkCreateSemaphore(device_, &info, nullptr, &timeline_); result != VK_SUCCESS)
        return error("to make a semaphore", result);
    name(VK_OBJECT_TYPE_SEMAPHORE, reinterpret_cast<std::uint64_t>(timeline_), "weft timeline");
    cache_file_ = options.pipeline_cache;
    load_pipeline_cache();
    memory_ = std::make_unique<Memory>(*this, options.memory_limit);
    return {};
}

Result<void> Device::look_at_queue() {
    const auto families = queue_families(physical_);
    if (queue_family_ >= families.size() || !(families[queue_family_].queueFlags & VK_QUEUE_COMPUTE_BIT))
        return Error{info_.name, "queue family " + std::to_string(queue_family_) + " does not compute"};
    info_.limits.timestamp_bits = families[queue_family_].timestampValidBits;
    draws_ = (families[queue_family_].queueFlags & VK_QUEUE_GRAPHICS_BIT) != 0;
    return {};
}

Device::~Device() {
    if (device_ == VK_NULL_HANDLE) return;
    if (submitted_ > 0) (void)wait(submitted_);
    save_pipeline_cache();
    memory_.reset();
    if (pipeline_cache_ != VK_NULL_HANDLE) vk_.vkDestroyPipelineCache(device_, pipeline_cache_, nullptr);
    if (timeline_ != VK_NULL_HANDLE) vk_.vkDestroySemaphore(device_, timeline_, nullptr);
    if (owned_) vk_.vkDestroyDevice(device_, nullptr);
}

Result<std::uint64_t> Device::submit(VkCommandBuffer commands, Moment after, BinarySemaphores binary) {
    const std::uint64_t value = submitted_ + 1;
    constexpr VkPipelineStageFlags everything[] = {VK_PIPELINE_STAGE_ALL_COMMANDS_BIT,
                                                   VK_PIPELINE_STAGE_ALL_COMMANDS_BIT};
    VkSemaphore waits[2]{}, signals[2] = {timeline_, binary.signal};
    std::uint64_t wait_values[2]{}, signal_values[2] = {value, 0};  // binary semaphores have no value
    std::uint32_t wait_count = 0;
    if (after.semaphore != VK_NULL_HANDLE) {
        waits[wait_count] = after.semaphore;
        wait_values[wait_count++] = after.value;
    }
    if (binary.wait != VK_NULL_HANDLE) waits[wait_count++] = binary.wait;
    const std::uint32_t signal_count = binary.signal == VK_NULL_HANDLE ? 1 : 2;
    VkTimelineSemaphoreSubmitInfo timeline{};
    timeline.sType = VK_STRUCTURE_TYPE_TIMELINE_SEMAPHORE_SUBMIT_INFO;
    timeline.waitSemaphoreValueCount = wait_count;
    timeline.pWaitSemaphoreValues = wait_values;
    timeline.signalSemaphoreValueCount = signal_count;
    timeline.pSignalSemaphoreValues = signal_values;
    VkSubmitInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
    info.pNext = &timeline;
    info.waitSemaphoreCount = wait_count;
    info.pWaitSemaphores = waits;
    info.pWaitDstStageMask = everything;
    info.commandBufferCount = 1;
    info.pCommandBuffers = &commands;
    info.signalSemaphoreCount = signal_count;
    info.pSignalSemaphores = signals;
    if (lock_queue_) lock_queue_();
    const VkResult result = vk_.vkQueueSubmit(queue_, 1, &info, VK_NULL_HANDLE);
    if (unlock_queue_) unlock_queue_();
    if (result != VK_SUCCESS) return error("to submit work", result);
    submitted_ = value;
    return value;
}

Result<void> Device::wait(std::uint64_t value) {
    VkSemaphoreWaitInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SEMAPHORE_WAIT_INFO;
    info.semaphoreCount = 1;
    info.pSemaphores = &timeline_;
    info.pValues = &value;
    const VkResult result = vk_.vkWaitSemaphores(device_, &info, std::numeric_limits<std::uint64_t>::max());
    if (result != VK_SUCCESS) return error("to finish its work", result);
    return {};
}

void Device::name(VkObjectType type, std::uint64_t handle, const std::string& text) const {
    const PFN_vkSetDebugUtilsObjectNameEXT set_name = instance_->set_name();
    if (set_name == nullptr || !owned_) return;
    VkDebugUtilsObjectNameInfoEXT info{};
    info.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT;
    info.objectType = type;
    info.objectHandle = handle;
    info.pObjectName = text.c_str();
    set_name(device_, &info);
}

void Device::load_pipeline_cache() {
    std::vector<char> data;
    if (!cache_file_.empty()) data = read_cache_file(cache_file_, pipeline_cache_format);
    VkPipelineCacheCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO;
    info.initialDataSize = data.size();  // a driver ignores data of another driver
    info.pInitialData = data.empty() ? nullptr : data.data();
    if (vk_.vkCreatePipelineCache(device_, &info, nullptr, &pipeline_cache_) == VK_SUCCESS) return;
    info.initialDataSize = 0;
    info.pInitialData = nullptr;
    if (vk_.vkCreatePipelineCache(device_, &info, nullptr, &pipeline_cache_) != VK_SUCCESS)
        pipeline_cache_ = VK_NULL_HANDLE;
}

void Device::save_pipeline_cache() const {
    if (cache_file_.empty() || pipeline_cache_ == VK_NULL_HANDLE) return;
    std::size_t size = 0;
    if (vk_.vkGetPipelineCacheData(device_, pipeline_cache_, &size, nullptr) != VK_SUCCESS || size == 0) return;
    std::vector<char> data(size);
    if (vk_.vkGetPipelineCacheData(device_, pipeline_cache_, &size, data.data()) != VK_SUCCESS) return;
    data.resize(size);
    (void)write_cache_file(cache_file_, pipeline_cache_format, data);
}

}  // namespace weft::gpu
