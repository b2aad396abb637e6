#include "gpu/vulkan.h"

namespace weft::gpu {

std::string result_name(VkResult result) {
    switch (result) {
#define WEFT_NAME(name) \
    case name:          \
        return #name
        WEFT_NAME(VK_SUCCESS);
        WEFT_NAME(VK_NOT_READY);
        WEFT_NAME(VK_TIMEOUT);
        WEFT_NAME(VK_ERROR_OUT_OF_HOST_MEMORY);
        WEFT_NAME(VK_ERROR_OUT_OF_DEVICE_MEMORY);
        WEFT_NAME(VK_ERROR_INITIALIZATION_FAILED);
        WEFT_NAME(VK_ERROR_DEVICE_LOST);
        WEFT_NAME(VK_ERROR_MEMORY_MAP_FAILED);
        WEFT_NAME(VK_ERROR_LAYER_NOT_PRESENT);
        WEFT_NAME(VK_ERROR_EXTENSION_NOT_PRESENT);
        WEFT_NAME(VK_ERROR_FEATURE_NOT_PRESENT);
        WEFT_NAME(VK_ERROR_INCOMPATIBLE_DRIVER);
        WEFT_NAME(VK_ERROR_TOO_MANY_OBJECTS);
        WEFT_NAME(VK_ERROR_FORMAT_NOT_SUPPORTED);
        WEFT_NAME(VK_ERROR_FRAGMENTED_POOL);
        WEFT_NAME(VK_ERROR_SURFACE_LOST_KHR);
        WEFT_NAME(VK_ERROR_NATIVE_WINDOW_IN_USE_KHR);
        WEFT_NAME(VK_ERROR_OUT_OF_DATE_KHR);
        WEFT_NAME(VK_SUBOPTIMAL_KHR);
        WEFT_NAME(VK_ERROR_INVALID_SHADER_NV);
#undef WEFT_NAME
        default:
            return "VkResult " + std::to_string(static_cast<int>(result));
    }
}

Error vulkan_error(std::string_view device, std::string_view doing, VkResult result) {
    std::string what = "failed " + std::string(doing) + ": " + result_name(result);
    if (result == VK_ERROR_OUT_OF_DEVICE_MEMORY || result == VK_ERROR_OUT_OF_HOST_MEMORY) {
        what += "; a smaller cloth, a device with more memory, or --backend cpu will do";
    } else if (result == VK_ERROR_DEVICE_LOST) {
        what += "; the driver has given the device up: the last finished frame is kept";
    }
    return Error::of_machine(std::string(device), std::move(what));
}

std::unique_lock<std::recursive_mutex> lock_loader() {
    static std::recursive_mutex mutex;
    return std::unique_lock(mutex);
}

}  // namespace weft::gpu
