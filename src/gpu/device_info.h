// Properties and limits of a Vulkan device.
#pragma once

#include <weft/result.h>

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace weft::gpu {

/// In order of preference.
enum class DeviceType { discrete, integrated, virtual_gpu, other, cpu };

std::string_view type_name(DeviceType type);

struct DeviceLimits {
    std::uint32_t shared_memory = 0;                 ///< bytes per workgroup
    std::uint32_t workgroup_invocations = 0;         ///< most in one workgroup
    std::array<std::uint32_t, 3> workgroup_size{};   ///< most along each axis
    std::array<std::uint32_t, 3> workgroup_count{};  ///< most in a dispatch
    std::uint32_t push_constants = 0;                ///< bytes
    std::uint32_t descriptor_sets = 0;               ///< most that can be bound at once
    std::uint32_t subgroup_size = 0;
    std::uint64_t largest_allocation = 0;     ///< bytes
    std::uint64_t largest_storage_range = 0;  ///< bytes
    double timestamp_period = 0;              ///< ns per tick
    std::uint32_t timestamp_bits = 0;         ///< valid bits of timestamps; 0 without a clock, or before a device has
                                              ///< chosen its queue
};

struct DeviceInfo {
    std::string name;
    DeviceType type = DeviceType::other;
    std::string driver;                  ///< name and version, as reported by the driver
    std::array<std::uint32_t, 3> api{};  ///< version of Vulkan
    std::uint64_t memory = 0;            ///< bytes of the largest device-local heap
    DeviceLimits limits;
    std::vector<std::string> missing;  ///< requirements that the device does not meet; empty if it is usable
    std::uint32_t index = 0;           ///< among the devices of its instance

    bool usable() const { return missing.empty(); }
    bool is_gpu() const { return type != DeviceType::cpu && type != DeviceType::other; }
};

/// "NVIDIA H100 (discrete, 79.2 GiB, Vulkan 1.3.242, NVIDIA 535.104)"
std::string describe(const DeviceInfo& info);

/// Returns the device whose name contains `name`, case-insensitive; a device whose whole name matches comes first.
/// Without a name, returns the best usable device: discrete before integrated before virtual and, with `software`,
/// before a software device. Fails if there is none; the error lists the devices.
Result<DeviceInfo> choose_device(std::span<const DeviceInfo> devices, std::string_view name, bool software);

}  // namespace weft::gpu
