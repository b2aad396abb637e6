// Common include for Vulkan: no prototypes, functions come from volk. Names of results for errors.
#pragma once

#include <volk.h>

#include <weft/result.h>

#include <mutex>
#include <string>
#include <string_view>

namespace weft::gpu {

/// "VK_ERROR_DEVICE_LOST"; unknown ones as numbers.
std::string result_name(VkResult result);

/// An error message, with advice if there is any. `doing`: "to allocate 64 MiB".
Error vulkan_error(std::string_view device, std::string_view doing, VkResult result);

/// volk's instance-level functions are global variables that every new instance overwrites. Hold this lock to create or
/// destroy an instance or a device.
std::unique_lock<std::recursive_mutex> lock_loader();

}  // namespace weft::gpu
