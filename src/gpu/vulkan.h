// Vulkan as every file of this folder sees it: no prototypes, functions come from volk. Names of results for errors.
#pragma once

#include <volk.h>

#include <weft/result.h>

#include <mutex>
#include <string>
#include <string_view>

namespace weft::gpu {

/// "VK_ERROR_DEVICE_LOST"; unknown ones as numbers.
std::string result_name(VkResult result);

/// What went wrong, with what to do about it where that is known. `doing`: "to allocate 64 MiB".
Error vulkan_error(std::string_view device, std::string_view doing, VkResult result);

/// volk's functions that need no device are variables of the whole program, written whenever an instance is made:
/// whoever makes an instance or a device, or gives one back, holds this.
std::unique_lock<std::recursive_mutex> lock_loader();

}  // namespace weft::gpu
