#ifdef WEFT_VULKAN
// The internal Vulkan headers must come before the public one, because they disable prototypes.
#include "gpu/device.h"
#include "solver/world/world.h"
#include "vulkan/interop.h"
#include "weft/simulation_access.h"

#include <weft/vulkan.h>

#include <string>

namespace weft {

namespace {

std::string version_text(std::uint32_t api) {
    return std::to_string(VK_API_VERSION_MAJOR(api)) + "." + std::to_string(VK_API_VERSION_MINOR(api));
}

Errors problems_of(const VulkanHost& host, const Options& options) {
    Errors errors;
    const auto need = [&](bool there, const char* what) {
        if (!there) errors.push_back({what, "must not be null"});
    };
    need(host.instance != VK_NULL_HANDLE, "instance");
    need(host.physical_device != VK_NULL_HANDLE, "physical_device");
    need(host.device != VK_NULL_HANDLE, "device");
    need(host.queue != VK_NULL_HANDLE, "queue");
    if (host.api_version < VK_API_VERSION_1_2)
        errors.push_back({"api_version", "must be at least 1.2, got " + version_text(host.api_version)});
    if (!host.lock_queue != !host.unlock_queue)
        errors.push_back({host.lock_queue ? "unlock_queue" : "lock_queue", "is missing: both are called, or neither"});
    if (options.backend != "auto" && options.backend != "vulkan")
        errors.push_back({"backend", "must be auto or vulkan on a host's device, got '" + options.backend + "'"});
    if (!options.device.empty())
        errors.push_back({"device", "must be empty on a host's device, got '" + options.device + "'"});
    return errors;
}

Result<std::unique_ptr<Backend>> make_backend_on(const VulkanHost& host, const Options& options) {
    if (Errors errors = problems_of(host, options); !errors.empty()) return errors;
    auto instance = gpu::Instance::adopt(host.instance, host.get_instance_proc_addr);
    if (!instance) return instance.errors();
    const gpu::HostDevice device{.physical = host.physical_device,
                                 .device = host.device,
                                 .queue = host.queue,
                                 .queue_family = host.queue_family,
                                 .lock_queue = host.lock_queue,
                                 .unlock_queue = host.unlock_queue};
    return make_vulkan_backend(std::move(*instance), device,
                               {.execution = options.execution, .timings = options.stage_timings});
}

Error not_on_vulkan(const Backend& backend) {
    return {"backend", "must be vulkan for buffers on a device, is " + std::string(backend.name())};
}

VulkanArray array(const gpu::BufferRange& range, VkFormat format, std::uint32_t stride) {
    if (range.buffer == VK_NULL_HANDLE) return {};
    return {.buffer = range.buffer,
            .offset = range.offset,
            .address = range.address,
            .format = format,
            .stride = stride,
            .count = static_cast<std::uint32_t>(range.size / stride)};
}

}  // namespace

MakeBackend SimulationAccess::backend_on(const VulkanHost& host) {
    return [&host](const Options& options) { return make_backend_on(host, options); };
}

Result<Simulation> create_on(const VulkanHost& host, const WorldDesc& world, const Options& options) {
    auto scene = empty_scene(world);
    if (!scene) return scene.errors();
    return SimulationAccess::create(std::move(*scene), options, {}, SimulationAccess::backend_on(host));
}

Result<VulkanHost> vulkan_device(const Simulation& simulation) {
    const Backend& backend = SimulationAccess::world(simulation).backend();
    const auto* interop = dynamic_cast<const VulkanInterop*>(&backend);
    if (!interop) return not_on_vulkan(backend);
    const gpu::Device& device = *interop->shared_device();
    return VulkanHost{.instance = device.instance().handle(),
                      .physical_device = device.physical(),
                      .device = device.handle(),
                      .queue = device.queue(),
                      .queue_family = device.queue_family(),
                      .get_instance_proc_addr = device.instance().functions(),
                      .lock_queue = device.lock_queue(),
                      .unlock_queue = device.unlock_queue()};
}

Result<VulkanSurface> vulkan_surface(Simulation& simulation, ClothId cloth, TimelinePoint before) {
    World& world = SimulationAccess::world(simulation);
    auto* interop = dynamic_cast<VulkanInterop*>(&world.backend());
    if (!interop) return not_on_vulkan(world.backend());
    if (!world.contains(cloth))
        return Error{"cloth", "is not in this simulation; it was removed or belongs to another one"};
    const auto surface = interop->surface(world.handle(cloth), {before.semaphore, before.value});
    if (!surface) return surface.errors();
    constexpr VkFormat four_floats = VK_FORMAT_R32G32B32A32_SFLOAT;
    return VulkanSurface{.positions = array(surface->positions, four_floats, 16),
                         .normals = array(surface->normals, four_floats, 16),
                         .tangents = array(surface->tangents, four_floats, 16),
                         .uvs = array(surface->uvs, VK_FORMAT_R32G32_SFLOAT, 8),
                         .triangles = array(surface->triangles, VK_FORMAT_R32G32B32_UINT, 12),
                         .ready = {surface->ready.semaphore, surface->ready.value}};
}

}  // namespace weft
#endif
