#include "weft/backends.h"

#include "cpu/cpu_backend.h"
#include "scene/nearest_name.h"
#ifdef WEFT_VULKAN
#include "vulkan/vulkan_backend.h"

#include <volk.h>
#endif

#include <algorithm>
#include <atomic>
#include <cstdlib>

namespace weft {
namespace {

#ifdef WEFT_VULKAN
std::atomic<int> submits_until_loss;
PFN_vkQueueSubmit submit_of_driver = nullptr;

VkResult VKAPI_CALL submit_or_lose(VkQueue queue, std::uint32_t count, const VkSubmitInfo* infos, VkFence fence) {
    if (--submits_until_loss < 0) return VK_ERROR_DEVICE_LOST;
    return submit_of_driver(queue, count, infos, fence);
}

/// For tests of programs: with WEFT_LOSE_DEVICE=N in the environment, the device is lost after N submits.
std::function<void(VolkDeviceTable&)> loss_from_environment() {
    const char* text = std::getenv("WEFT_LOSE_DEVICE");
    if (!text || !*text) return {};
    return [submits = std::atoi(text)](VolkDeviceTable& table) {
        submits_until_loss = submits;
        submit_of_driver = table.vkQueueSubmit;
        table.vkQueueSubmit = submit_or_lose;
    };
}
#endif

Result<std::unique_ptr<Backend>> make_vulkan(const Options& options) {
#ifdef WEFT_VULKAN
    return make_vulkan_backend({.execution = options.execution,
                                .device = options.device,
                                .software = options.backend == "vulkan",
                                .timings = options.stage_timings,
                                .intercept = loss_from_environment()});
#else
    (void)options;
    return Error::of_machine("backend", "this build has no Vulkan");
#endif
}

}  // namespace

Result<std::unique_ptr<Backend>> make_backend(const Options& options) {
    if (std::ranges::find(backend_names, options.backend) == backend_names.end())
        return Error{"backend", "must be " + alternatives(backend_names) + ", got '" + options.backend + "'"};
    if (options.backend == "cpu" && !options.device.empty())
        return Error{"device", "names a Vulkan device, and the backend is cpu"};
    if (options.backend != "cpu") {
        auto vulkan = make_vulkan(options);
        // If the options name a device, do not fall back to the CPU.
        if (vulkan || options.backend == "vulkan" || !options.device.empty()) return vulkan;
    }
    return make_cpu_backend({.workers = options.threads - 1, .isa = options.isa});
}

}  // namespace weft
