// The backend that runs on a Vulkan device.
#pragma once

#include "gpu/device_info.h"
#include "solver/world/backend.h"

#include <weft/result.h>

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

struct VolkDeviceTable;

namespace weft {

/// How a frame becomes dispatches: `streamed` one per pass, `grouped` one for all passes of coarse levels that are too
/// small for that, `fused` one for the whole frame, with a workgroup to a cloth; the same bits. `auto`: fused where a
/// workgroup has room for the cloth, grouped otherwise; streamed where software plays the GPU, for which a workgroup is
/// one thread.
inline constexpr std::array<std::string_view, 4> execution_names = {"auto", "streamed", "grouped", "fused"};

struct VulkanOptions {
    std::string execution = "auto";
    /// Part of the device's name, in whatever case; empty: the best GPU there is.
    std::string device = {};
    /// Whether a CPU that plays the GPU will do where there is none, and no name is given.
    bool software = true;
    /// Times for each stage, which cost a little; without, none.
    bool timings = false;
    /// Bytes: never takes more of the device than this; 0: as much as there is.
    std::uint64_t memory_limit = 0;
    /// For one that shows pictures in windows: gpu::InstanceOptions.
    std::vector<std::string> surface_extensions = {};
    /// Validation layers, for tests; what they say.
    bool validation = false;
    std::function<void(std::string_view)> on_message = {};
    /// For tests: lets calls fail that a healthy device never does.
    std::function<void(VolkDeviceTable&)> intercept = {};
};

/// Fails without a Vulkan loader, a driver, a device of that name, or one that can do what is needed.
Result<std::unique_ptr<Backend>> make_vulkan_backend(const VulkanOptions& options = {});

/// Every device there is, those that will not do among them; empty without a loader or driver.
std::vector<gpu::DeviceInfo> vulkan_devices();

}  // namespace weft
