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

/// How a frame becomes dispatches. All give the same bits.
/// - `streamed`: one dispatch per pass.
/// - `grouped`: one dispatch for consecutive passes of coarse levels that are too small for one each.
/// - `fused`: one dispatch for the whole frame, one workgroup per cloth.
/// - `auto`: fused if a workgroup has room for the cloth, grouped otherwise; streamed on a software device, which runs
///   a workgroup on one thread.
inline constexpr std::array<std::string_view, 4> execution_names = {"auto", "streamed", "grouped", "fused"};

struct VulkanOptions {
    std::string execution = "auto";
    /// Part of the device's name, case-insensitive; empty: the best GPU.
    std::string device = {};
    /// Whether to use a software device (on the CPU) if there is no GPU and `device` is empty.
    bool software = true;
    /// Measures the time of each stage, at a small cost.
    bool timings = false;
    /// Largest amount of device memory to use, in bytes; 0: no limit.
    std::uint64_t memory_limit = 0;
    /// For tests: searches for pairs of cloth in every substep. The result is the same.
    bool search_always = false;
    /// For presentation in windows: see gpu::InstanceOptions.
    std::vector<std::string> surface_extensions = {};
    /// Enables validation layers, for tests. `on_message` gets their messages.
    bool validation = false;
    std::function<void(std::string_view)> on_message = {};
    /// For tests: replaces functions of the device, so that calls can fail.
    std::function<void(VolkDeviceTable&)> intercept = {};
};

/// Fails without a Vulkan loader, a driver, a device of that name, or a device with the required features.
Result<std::unique_ptr<Backend>> make_vulkan_backend(const VulkanOptions& options = {});

/// All devices, including unsuitable ones; empty without a loader or driver.
std::vector<gpu::DeviceInfo> vulkan_devices();

}  // namespace weft
