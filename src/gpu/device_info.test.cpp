#include "gpu/device_info.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace weft::gpu {
namespace {

using testing::HasSubstr;

DeviceInfo device(std::string name, DeviceType type, std::vector<std::string> missing = {}) {
    DeviceInfo info;
    info.name = std::move(name);
    info.type = type;
    info.missing = std::move(missing);
    return info;
}

// The name of the chosen device, or the error message.
std::string chosen(std::span<const DeviceInfo> devices, std::string_view name, bool software) {
    const auto info = choose_device(devices, name, software);
    if (!info) {
        EXPECT_EQ(info.error().fault, Fault::machine);
        return info.error().message();
    }
    return info->name;
}

const std::vector<DeviceInfo> every_type = {device("software", DeviceType::cpu), device("something", DeviceType::other),
                                            device("guest", DeviceType::virtual_gpu),
                                            device("chip", DeviceType::integrated),
                                            device("card", DeviceType::discrete)};

TEST(ChooseDevice, takes_the_best_type_there_is) {
    auto devices = every_type;
    for (const char* expected : {"card", "chip", "guest"}) {
        EXPECT_EQ(chosen(devices, "", false), expected);
        EXPECT_EQ(chosen(devices, "", true), expected);
        devices.pop_back();
    }
    EXPECT_EQ(chosen(devices, "", true), "something");
    EXPECT_EQ(chosen(devices, "", false), "Vulkan: there is no GPU, only 'software', 'something'");
    devices.pop_back();
    EXPECT_EQ(chosen(devices, "", true), "software");
    EXPECT_EQ(chosen(devices, "", false), "Vulkan: there is no GPU, only 'software'");
}

TEST(ChooseDevice, of_equal_ones_takes_the_first) {
    std::vector<DeviceInfo> devices = {device("card", DeviceType::discrete), device("card", DeviceType::discrete)};
    devices[1].index = 1;
    EXPECT_EQ(choose_device(devices, "", true)->index, 0u);
    EXPECT_EQ(choose_device(devices, "card", true)->index, 0u);
}

TEST(ChooseDevice, a_name_is_a_part_in_any_case_and_the_whole_name_goes_first) {
    const std::vector<DeviceInfo> devices = {device("Radeon Pro 9", DeviceType::discrete),
                                             device("Radeon Pro", DeviceType::integrated),
                                             device("llvmpipe (LLVM)", DeviceType::cpu)};
    EXPECT_EQ(chosen(devices, "radeon", false), "Radeon Pro 9");
    EXPECT_EQ(chosen(devices, "PRO 9", false), "Radeon Pro 9");
    EXPECT_EQ(chosen(devices, "radeon pro", false), "Radeon Pro") << "the whole name, though the other is discrete";
    EXPECT_EQ(chosen(devices, "LLVM", false), "llvmpipe (LLVM)") << "asked for by name it is allowed";
    EXPECT_EQ(chosen(devices, "GeForce", true),
              "device 'GeForce': there is none; there are 'Radeon Pro 9', 'Radeon Pro', 'llvmpipe (LLVM)'");
}

TEST(ChooseDevice, what_lacks_something_comes_last_and_does_not_do) {
    std::vector<DeviceInfo> devices = {device("old card", DeviceType::discrete, {"Vulkan 1.2"}),
                                       device("chip", DeviceType::integrated)};
    EXPECT_EQ(chosen(devices, "", false), "chip");
    EXPECT_THAT(chosen(devices, "card", true),
                HasSubstr("device 'card': no suitable device: 'old card', which lacks Vulkan 1.2"));
    devices[1].missing = {"bufferDeviceAddress", "timelineSemaphore"};
    EXPECT_EQ(chosen(devices, "", true),
              "Vulkan: no suitable device: 'old card', which lacks Vulkan 1.2, 'chip', which lacks bufferDeviceAddress "
              "and timelineSemaphore");
}

TEST(ChooseDevice, without_any_device_says_what_to_install) {
    EXPECT_THAT(chosen({}, "", true), HasSubstr("there is no device; install a driver"));
    EXPECT_THAT(chosen({}, "card", false), HasSubstr("there is no device; install a driver"));
}

TEST(DeviceInfo, is_described_on_a_line) {
    DeviceInfo info = device("NVIDIA H100", DeviceType::discrete);
    info.driver = "NVIDIA 535.104";
    info.api = {1, 3, 242};
    info.memory = std::uint64_t{79} << 30;
    EXPECT_EQ(describe(info), "NVIDIA H100 (discrete, 79.0 GiB, Vulkan 1.3.242, NVIDIA 535.104)");
}

}  // namespace
}  // namespace weft::gpu
