#include "vulkan/device_options.h"

#include "base/cache_file.h"
#include "vulkan/interop.h"

#include <cctype>

namespace weft {
namespace vulkan {
namespace {

// Empty if nothing is to be kept.
std::filesystem::path pipeline_cache_file(const gpu::DeviceInfo& device) {
    const std::filesystem::path folder = cache_folder();
    if (folder.empty()) return {};
    std::string name = device.name + "-" + device.driver;
    for (char& c : name) {
        if (!std::isalnum(static_cast<unsigned char>(c)) && c != '.' && c != '-') c = '_';
    }
    return folder / (name + ".pipelines");
}

}  // namespace

gpu::DeviceOptions device_options(const gpu::DeviceInfo& info, const VulkanOptions& options) {
    return {.pipeline_cache = pipeline_cache_file(info),
            .memory_limit = options.memory_limit,
            .intercept = options.intercept};
}

}  // namespace vulkan

Result<std::shared_ptr<gpu::Device>> make_vulkan_device(const VulkanOptions& options) {
    auto instance = gpu::Instance::create({.validation = options.validation,
                                           .surface_extensions = options.surface_extensions,
                                           .on_message = options.on_message});
    if (!instance) return instance.errors();
    auto info = gpu::choose_device((*instance)->devices(), options.device, options.software);
    if (!info) return info.errors();
    return gpu::Device::create(*instance, *info, vulkan::device_options(*info, options));
}

std::vector<gpu::DeviceInfo> vulkan_devices() {
    auto instance = gpu::Instance::create();
    return instance ? (*instance)->devices() : std::vector<gpu::DeviceInfo>{};
}

}  // namespace weft
