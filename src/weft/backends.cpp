#include "weft/backends.h"

#include "cpu/cpu_backend.h"
#include "scene/nearest_name.h"
#ifdef WEFT_VULKAN
#include "vulkan/vulkan_backend.h"
#endif

#include <algorithm>

namespace weft {
namespace {

Result<std::unique_ptr<Backend>> make_vulkan(const Options& options) {
#ifdef WEFT_VULKAN
    return make_vulkan_backend({.execution = options.execution,
                                .device = options.device,
                                .software = options.backend == "vulkan",
                                .timings = options.stage_timings});
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
