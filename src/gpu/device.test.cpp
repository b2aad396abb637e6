#include "gpu/device.h"

#include "gpu/host_device.test.h"
#include "gpu/image.h"
#include "gpu/memory.h"
#include "gpu/test_device.h"

#include <gmock/gmock.h>

#include <thread>

namespace weft::gpu {
namespace {

using testing::HasSubstr;

// Simulates a lost device. The real call is made too, so that nothing is destroyed while it is in use.
VolkDeviceTable healthy;
bool lost_on_submit, lost_on_wait;

VKAPI_ATTR VkResult VKAPI_CALL submit(VkQueue queue, std::uint32_t count, const VkSubmitInfo* infos, VkFence fence) {
    return lost_on_submit ? VK_ERROR_DEVICE_LOST : healthy.vkQueueSubmit(queue, count, infos, fence);
}
VKAPI_ATTR VkResult VKAPI_CALL wait(VkDevice device, const VkSemaphoreWaitInfo* info, std::uint64_t timeout) {
    const VkResult result = healthy.vkWaitSemaphores(device, info, timeout);
    return lost_on_wait ? VK_ERROR_DEVICE_LOST : result;
}
void lose(VolkDeviceTable& table) {
    healthy = table;
    lost_on_submit = lost_on_wait = false;
    table.vkQueueSubmit = submit;
    table.vkWaitSemaphores = wait;
}

void destroy(const HostDevice& host) {
    const auto function = vkGetDeviceProcAddr(host.device, "vkDestroyDevice");
    reinterpret_cast<PFN_vkDestroyDevice>(function)(host.device, nullptr);
}

class DeviceTest : public OnDevice {
  protected:
    Result<void> fill_something() {
        const Buffer a = make(64, MemoryKind::device);
        return run_once(*device, [&](Commands& commands) { commands.fill(a, 1); });
    }
    // A device as a host application creates it.
    HostDevice host_device() {
        HostDevice host{.physical = instance->physical(info)};
        host.device = make_host_device(host.physical);
        return host;
    }
};

TEST_F(DeviceTest, a_device_lost_on_submit_is_an_error_and_the_rest_can_be_taken_down) {
    open({.intercept = lose});
    if (!device) return;
    ASSERT_TRUE(fill_something().ok());
    const std::uint64_t before = device->submitted();
    lost_on_submit = true;
    const auto result = fill_something();
    ASSERT_FALSE(result.ok());
    EXPECT_EQ(result.error().where, info.name);
    EXPECT_EQ(result.error().fault, Fault::machine);
    EXPECT_THAT(result.error().what, HasSubstr("failed to submit work: VK_ERROR_DEVICE_LOST; the driver has given"));
    EXPECT_EQ(device->submitted(), before) << "or a wait for it would have no end";
    lost_on_submit = false;
    EXPECT_TRUE(fill_something().ok()) << "nothing was left half done";
}

TEST_F(DeviceTest, a_device_lost_on_wait_is_an_error_and_the_rest_can_be_taken_down) {
    open({.intercept = lose});
    if (!device) return;
    auto commands = Commands::create(*device, 2);
    ASSERT_TRUE(commands.ok() && commands->begin().ok());
    commands->stamp();
    commands->stamp();
    ASSERT_TRUE(commands->end().ok());
    const auto value = commands->submit();
    ASSERT_TRUE(value.ok());
    lost_on_wait = true;
    const auto result = device->wait(*value);
    ASSERT_FALSE(result.ok());
    EXPECT_EQ(result.error().fault, Fault::machine);
    EXPECT_THAT(result.error().what, HasSubstr("failed to finish its work: VK_ERROR_DEVICE_LOST"));
    (void)commands->intervals();  // must return
}

TEST_F(DeviceTest, intervals_of_what_could_not_be_submitted_are_none) {
    open({.intercept = lose});
    if (!device) return;
    auto commands = Commands::create(*device, 2);
    ASSERT_TRUE(commands.ok() && commands->begin().ok());
    commands->stamp();
    commands->stamp();
    ASSERT_TRUE(commands->end().ok());
    lost_on_submit = true;
    EXPECT_FALSE(commands->submit().ok());
    EXPECT_TRUE(commands->intervals().empty());
}

TEST_F(DeviceTest, a_host_may_share_its_own) {
    if (!instance) return;
    const HostDevice host = host_device();
    const auto vk_instance = instance->handle();
    {
        auto shared = Instance::adopt(vk_instance);
        ASSERT_TRUE(shared.ok()) << shared.error().message();
        for (const std::uint64_t limit : {0, 1 << 20}) {
            auto made = Device::adopt(*shared, host, {.memory_limit = limit});
            ASSERT_TRUE(made.ok()) << made.error().message();
            device = std::move(*made);
            EXPECT_EQ(device->info().name, info.name);
            EXPECT_EQ(device->handle(), host.device);
            EXPECT_GT(device->limits().timestamp_bits, 0u);
            EXPECT_TRUE(fill_something().ok());
            device.reset();
        }
    }
    destroy(host);
}

TEST_F(DeviceTest, what_cannot_be_shared_is_an_error) {
    if (!instance) return;
    EXPECT_FALSE(Instance::adopt(VK_NULL_HANDLE).ok());
    const HostDevice host = host_device();
    HostDevice wrong = host;
    wrong.physical = VK_NULL_HANDLE;
    auto made = Device::adopt(instance, wrong);
    ASSERT_FALSE(made.ok());
    EXPECT_THAT(made.error().what, HasSubstr("does not belong to the instance"));
    wrong = {.physical = host.physical};
    made = Device::adopt(instance, wrong);
    ASSERT_FALSE(made.ok());
    EXPECT_THAT(made.error().what, HasSubstr("VulkanHost::device is null"));
    wrong = host;
    wrong.queue_family = 1000;
    made = Device::adopt(instance, wrong);
    ASSERT_FALSE(made.ok());
    EXPECT_THAT(made.error().what, HasSubstr("queue family 1000 does not compute"));
    destroy(host);
}

VKAPI_ATTR void VKAPI_CALL properties_of_another(VkPhysicalDevice, VkPhysicalDeviceProperties* properties) {
    ADD_FAILURE() << "asked through another instance";
    *properties = {};
}
VKAPI_ATTR void VKAPI_CALL memory_of_another(VkPhysicalDevice, VkPhysicalDeviceMemoryProperties* properties) {
    ADD_FAILURE() << "asked through another instance";
    *properties = {};
}
VKAPI_ATTR VkResult VKAPI_CALL formats_of_another(VkPhysicalDevice, VkFormat, VkImageType, VkImageTiling,
                                                  VkImageUsageFlags, VkImageCreateFlags, VkImageFormatProperties*) {
    ADD_FAILURE() << "asked through another instance";
    return VK_ERROR_FORMAT_NOT_SUPPORTED;
}

// volk's variables hold the functions of the last instance that was made, which may come from another loader.
TEST_F(DeviceTest, calls_the_functions_of_its_own_instance_after_another_one_was_made) {
    open();
    if (!device) return;
    const auto disturb = [] {
        const auto lock = lock_loader();
        vkGetPhysicalDeviceProperties = properties_of_another;
        vkGetPhysicalDeviceMemoryProperties = memory_of_another;
        vkGetPhysicalDeviceImageFormatProperties = formats_of_another;
    };
    disturb();
    EXPECT_GE(supported_samples(*device, 1), 1u);
    disturb();
    EXPECT_TRUE(Image::create(*device, {}, "one").ok());
    disturb();
    const Memory memory(*device, 1 << 20);
    instance->take_functions();
}

// A host's instance without the extension for messages must not disable that of another instance.
TEST_F(DeviceTest, instances_come_and_go_beside_one_another) {
    if (!instance) return;
    open();
    if (!device) return;
    VkInstanceCreateInfo create{};
    VkApplicationInfo application{};
    application.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
    application.apiVersion = VK_API_VERSION_1_2;
    create.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
    create.pApplicationInfo = &application;
    VkInstance plain = VK_NULL_HANDLE;
    ASSERT_EQ(vkCreateInstance(&create, nullptr, &plain), VK_SUCCESS);
    {
        auto shared = Instance::adopt(plain);
        ASSERT_TRUE(shared.ok());
        EXPECT_EQ((*shared)->devices().size(), instance->devices().size());
        EXPECT_TRUE(fill_something().ok()) << "buffers are named through an instance of their own";
    }
    vkDestroyInstance(plain, nullptr);
    std::vector<std::thread> threads;
    for (int i = 0; i < 4; ++i) threads.emplace_back([] { EXPECT_TRUE(Instance::create().ok()); });
    for (std::thread& thread : threads) thread.join();
    EXPECT_TRUE(fill_something().ok());
}

TEST_F(DeviceTest, its_limits_are_what_vulkan_promises) {
    open();
    if (!device) return;
    const DeviceLimits& limits = device->limits();
    EXPECT_GE(limits.shared_memory, 16384u);
    EXPECT_GE(limits.workgroup_invocations, 128u);
    EXPECT_GE(limits.workgroup_size[0], 128u);
    EXPECT_GE(limits.workgroup_count[0], 65535u);
    EXPECT_GE(limits.push_constants, 128u);
    EXPECT_GE(limits.descriptor_sets, 4u);
    EXPECT_GE(limits.largest_allocation, std::uint64_t{1} << 27);
    EXPECT_GE(limits.largest_storage_range, std::uint64_t{1} << 27);
    EXPECT_TRUE(limits.timestamp_bits == 0 || limits.timestamp_bits >= 36);
    EXPECT_THAT(describe(device->info()), HasSubstr(info.name));
}

TEST(VulkanError, says_what_to_do_where_that_is_known) {
    EXPECT_EQ(result_name(VK_ERROR_DEVICE_LOST), "VK_ERROR_DEVICE_LOST");
    EXPECT_EQ(result_name(static_cast<VkResult>(-12345)), "VkResult -12345");
    const Error error = vulkan_error("card", "to do it", VK_ERROR_OUT_OF_DEVICE_MEMORY);
    EXPECT_EQ(error.message(),
              "card: failed to do it: VK_ERROR_OUT_OF_DEVICE_MEMORY; a smaller cloth, a device with "
              "more memory, or --backend cpu will do");
    EXPECT_EQ(error.fault, Fault::machine);
}

}  // namespace
}  // namespace weft::gpu
