// A program with its own Vulkan device, on which weft simulates its cloth. It copies the surface from the buffers that
// the simulation fills, where another program would draw from them, and checks their content.
#include <volk.h>  // or <vulkan/vulkan.h> and the loader

#include <weft/vulkan.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <span>
#include <vector>

namespace {

void must(bool worked, const char* what) {
    if (worked) return;
    std::cerr << "failed: " << what << '\n';
    std::exit(1);
}

// VulkanHost describes everything that weft needs to know.
weft::VulkanHost open_device() {
    weft::VulkanHost host;
    must(volkInitialize() == VK_SUCCESS, "to find a Vulkan loader");
    VkApplicationInfo application{.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO, .apiVersion = VK_API_VERSION_1_2};
    VkInstanceCreateInfo instance{.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO, .pApplicationInfo = &application};
    must(vkCreateInstance(&instance, nullptr, &host.instance) == VK_SUCCESS, "to make an instance");
    volkLoadInstance(host.instance);

    std::uint32_t count = 1;
    vkEnumeratePhysicalDevices(host.instance, &count, &host.physical_device);
    must(count == 1, "to find a device");
    std::uint32_t families = 16;
    std::array<VkQueueFamilyProperties, 16> properties{};
    vkGetPhysicalDeviceQueueFamilyProperties(host.physical_device, &families, properties.data());
    const auto computes = [](const auto& family) { return (family.queueFlags & VK_QUEUE_COMPUTE_BIT) != 0; };
    host.queue_family = static_cast<std::uint32_t>(std::ranges::find_if(properties, computes) - properties.begin());
    must(host.queue_family < families, "to find a queue that computes");

    const float priority = 1;
    VkDeviceQueueCreateInfo queue{.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
                                  .queueFamilyIndex = host.queue_family,
                                  .queueCount = 1,
                                  .pQueuePriorities = &priority};
    VkPhysicalDeviceVulkan12Features features{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES,
                                              .hostQueryReset = VK_TRUE,
                                              .timelineSemaphore = VK_TRUE,
                                              .bufferDeviceAddress = VK_TRUE};
    VkDeviceCreateInfo device{.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
                              .pNext = &features,
                              .queueCreateInfoCount = 1,
                              .pQueueCreateInfos = &queue};
    must(vkCreateDevice(host.physical_device, &device, nullptr, &host.device) == VK_SUCCESS, "to open the device");
    volkLoadDevice(host.device);
    vkGetDeviceQueue(host.device, host.queue_family, 0, &host.queue);
    host.get_instance_proc_addr = vkGetInstanceProcAddr;
    return host;
}

// Memory that host and device share, and commands that fill it.
class Reader {
  public:
    Reader(const weft::VulkanHost& host, VkDeviceSize bytes) : host_(host) {
        VkBufferCreateInfo buffer{
            .sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO, .size = bytes, .usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT};
        must(vkCreateBuffer(host.device, &buffer, nullptr, &buffer_) == VK_SUCCESS, "to make a buffer");
        VkMemoryRequirements needs{};
        vkGetBufferMemoryRequirements(host.device, buffer_, &needs);
        VkPhysicalDeviceMemoryProperties memory{};
        vkGetPhysicalDeviceMemoryProperties(host.physical_device, &memory);
        constexpr VkFlags seen = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
        std::uint32_t type = 0;
        while (!(needs.memoryTypeBits >> type & 1) || (memory.memoryTypes[type].propertyFlags & seen) != seen) ++type;
        VkMemoryAllocateInfo allocation{
            .sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, .allocationSize = needs.size, .memoryTypeIndex = type};
        must(vkAllocateMemory(host.device, &allocation, nullptr, &memory_) == VK_SUCCESS, "to allocate memory");
        must(vkBindBufferMemory(host.device, buffer_, memory_, 0) == VK_SUCCESS, "to bind memory");
        must(vkMapMemory(host.device, memory_, 0, VK_WHOLE_SIZE, 0, &mapped_) == VK_SUCCESS, "to map memory");

        VkCommandPoolCreateInfo pool{.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                                     .queueFamilyIndex = host.queue_family};
        must(vkCreateCommandPool(host.device, &pool, nullptr, &pool_) == VK_SUCCESS, "to make a command pool");
        VkCommandBufferAllocateInfo commands{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                             .commandPool = pool_,
                                             .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
                                             .commandBufferCount = 1};
        must(vkAllocateCommandBuffers(host.device, &commands, &commands_) == VK_SUCCESS, "to make commands");
    }
    ~Reader() {
        vkDestroyCommandPool(host_.device, pool_, nullptr);
        vkDestroyBuffer(host_.device, buffer_, nullptr);
        vkFreeMemory(host_.device, memory_, nullptr);
    }
    Reader(const Reader&) = delete;

    /// The content of the array once `ready` is reached.
    template <class T>
    std::vector<T> read(const weft::VulkanArray& array, weft::TimelinePoint ready) {
        vkResetCommandPool(host_.device, pool_, 0);
        VkCommandBufferBeginInfo begin{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
        vkBeginCommandBuffer(commands_, &begin);
        const VkBufferCopy all{array.offset, 0, VkDeviceSize{array.stride} * array.count};
        vkCmdCopyBuffer(commands_, array.buffer, buffer_, 1, &all);
        VkMemoryBarrier to_host{.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER,
                                .srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT,
                                .dstAccessMask = VK_ACCESS_HOST_READ_BIT};
        vkCmdPipelineBarrier(commands_, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &to_host, 0,
                             nullptr, 0, nullptr);
        vkEndCommandBuffer(commands_);

        VkTimelineSemaphoreSubmitInfo values{.sType = VK_STRUCTURE_TYPE_TIMELINE_SEMAPHORE_SUBMIT_INFO,
                                             .waitSemaphoreValueCount = 1,
                                             .pWaitSemaphoreValues = &ready.value};
        const VkPipelineStageFlags stage = VK_PIPELINE_STAGE_TRANSFER_BIT;
        VkSubmitInfo submit{.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO,
                            .pNext = &values,
                            .waitSemaphoreCount = 1,
                            .pWaitSemaphores = &ready.semaphore,
                            .pWaitDstStageMask = &stage,
                            .commandBufferCount = 1,
                            .pCommandBuffers = &commands_};
        must(vkQueueSubmit(host_.queue, 1, &submit, VK_NULL_HANDLE) == VK_SUCCESS, "to submit");
        must(vkQueueWaitIdle(host_.queue) == VK_SUCCESS, "to wait");
        std::vector<T> values_read(array.count);
        must(sizeof(T) == array.stride, "to know the format");
        std::memcpy(values_read.data(), mapped_, array.count * sizeof(T));
        return values_read;
    }

  private:
    const weft::VulkanHost& host_;
    VkBuffer buffer_ = VK_NULL_HANDLE;
    VkDeviceMemory memory_ = VK_NULL_HANDLE;
    void* mapped_ = nullptr;
    VkCommandPool pool_ = VK_NULL_HANDLE;
    VkCommandBuffer commands_ = VK_NULL_HANDLE;
};

bool same(std::span<const weft::Vec4> device, std::span<const weft::Vec3> host) {
    return std::ranges::equal(device, host, {}, &weft::Vec4::xyz);
}

void drape(const weft::VulkanHost& host) {
    auto world = weft::create_on(host);
    if (!world) std::cerr << world.error().message() << '\n';
    must(world.ok(), "to make a simulation on the host's device");
    const auto ball = world->add(weft::ColliderDesc{.shape = weft::SphereDesc{0.2f}});
    const auto cloth = world->add({.mesh = weft::GridDesc{.size = {0.6f, 0.6f}, .resolution = {24, 24}},
                                   .transform = {.position = {0, 0.22f, 0}}});
    must(ball.ok() && cloth.ok(), "to fill the world");
    Reader reader(host, 1 << 20);
    for (int frame = 1; frame <= 20; ++frame) {
        world->step();
        const auto surface = weft::vulkan_surface(*world, *cloth);
        must(surface.ok(), "to get the surface");
        const auto positions = reader.read<weft::Vec4>(surface->positions, surface->ready);
        const auto normals = reader.read<weft::Vec4>(surface->normals, surface->ready);
        const weft::Surface expected = world->surface(*cloth);
        must(same(positions, expected.positions) && same(normals, expected.normals), "to see the same surface");
        if (frame % 5 == 0)
            std::cout << "frame " << frame << ": lowest point at " << std::ranges::min(positions, {}, &weft::Vec4::y).y
                      << " m\n";
        if (frame > 1) continue;
        const auto triangles = reader.read<std::array<std::uint32_t, 3>>(surface->triangles, surface->ready);
        must(std::ranges::equal(triangles, expected.triangles), "to see the same triangles");
    }
}

}  // namespace

int main() {
    const weft::VulkanHost host = open_device();
    drape(host);  // the simulation must be destroyed before its device
    vkDestroyDevice(host.device, nullptr);
    vkDestroyInstance(host.instance, nullptr);
}
