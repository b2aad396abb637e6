#include "gpu/device_info.h"

#include <algorithm>
#include <cctype>
#include <cstdio>

namespace weft::gpu {
namespace {

std::string lower(std::string_view text) {
    std::string result(text);
    for (char& c : result) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return result;
}

std::string list_of(std::span<const DeviceInfo> devices) {
    std::string text;
    for (const DeviceInfo& device : devices) {
        text += (text.empty() ? "'" : ", '") + device.name + "'";
        for (std::size_t i = 0; i < device.missing.size(); ++i)
            text += (i == 0 ? ", which lacks " : " and ") + device.missing[i];
    }
    return text;
}

const DeviceInfo* best_of(const std::vector<const DeviceInfo*>& devices) {
    const auto best = std::ranges::min_element(devices, {}, [](const DeviceInfo* one) {
        return std::pair(!one->usable(), one->type);  // the first among equal ones
    });
    return best == devices.end() ? nullptr : *best;
}

}  // namespace

std::string_view type_name(DeviceType type) {
    switch (type) {
        case DeviceType::discrete:
            return "discrete";
        case DeviceType::integrated:
            return "integrated";
        case DeviceType::virtual_gpu:
            return "virtual";
        case DeviceType::cpu:
            return "cpu";
        case DeviceType::other:
            return "other";
    }
    return "other";
}

std::string describe(const DeviceInfo& info) {
    char numbers[64];
    std::snprintf(numbers, sizeof numbers, "%.1f GiB, Vulkan %u.%u.%u", static_cast<double>(info.memory) / (1 << 30),
                  info.api[0], info.api[1], info.api[2]);
    return info.name + " (" + std::string(type_name(info.type)) + ", " + numbers + ", " + info.driver + ")";
}

Result<DeviceInfo> choose_device(std::span<const DeviceInfo> devices, std::string_view name, bool software) {
    if (devices.empty()) {
        return Error::of_machine(
            "Vulkan", "there is no device; install a driver for the GPU, or mesa-vulkan-drivers for one in software");
    }
    const std::string where = name.empty() ? "Vulkan" : "device '" + std::string(name) + "'";
    std::vector<const DeviceInfo*> candidates, exact;
    for (const DeviceInfo& device : devices) {
        if (name.empty() ? device.is_gpu() || software : lower(device.name).find(lower(name)) != std::string::npos)
            candidates.push_back(&device);
        if (!name.empty() && lower(device.name) == lower(name)) exact.push_back(&device);
    }
    const DeviceInfo* best = best_of(exact.empty() ? candidates : exact);
    if (!best) {
        return Error::of_machine(
            where, (name.empty() ? "there is no GPU, only " : "there is none; there are ") + list_of(devices));
    }
    if (!best->usable()) return Error::of_machine(where, "no suitable device: " + list_of(devices));
    return *best;
}

}  // namespace weft::gpu
