// One Vulkan device for a host and its cloth: the host passes its own, and draws from the buffers that the simulation
// fills, without a way over the CPU. The only header of weft that needs Vulkan's.
//
//     auto world = weft::create_on(host, {});                      // or load_on(host, "scene.json")
//     auto cloth = world->add({.mesh = weft::GridDesc{}});
//     world->step();
//     auto surface = weft::vulkan_surface(*world, *cloth);         // in every frame
//     // submit work that waits for surface->ready and reads surface->positions, surface->triangles, …
#pragma once

#include <weft/simulation.h>

#include <vulkan/vulkan_core.h>

#include <cstdint>
#include <functional>

namespace weft {

/// What a host shares. It stays the host's: weft destroys nothing of it, and all of it must outlive the simulation.
///
/// The host has made the instance for Vulkan 1.2 or later, and the device with the features bufferDeviceAddress,
/// timelineSemaphore and hostQueryReset of VkPhysicalDeviceVulkan12Features (or of the structures of their own). Vulkan
/// cannot be asked what was enabled, so weft takes that on trust; what the physical device can do at all it checks.
struct VulkanHost {
    VkInstance instance = VK_NULL_HANDLE;
    VkPhysicalDevice physical_device = VK_NULL_HANDLE;  ///< one of the instance's
    VkDevice device = VK_NULL_HANDLE;
    VkQueue queue = VK_NULL_HANDLE;  ///< of `queue_family`, without flags of its own
    std::uint32_t queue_family = 0;  ///< computes; and draws, where the host wants to draw from the buffers
    /// What VkApplicationInfo::apiVersion said; VK_API_VERSION_1_2 or later.
    std::uint32_t api_version = VK_API_VERSION_1_2;
    /// Where the host's functions come from; without, the system's loader (libvulkan.so.1).
    PFN_vkGetInstanceProcAddr get_instance_proc_addr = nullptr;
    /// The queue is used within calls of the simulation's functions, from the thread that makes them. Where another
    /// thread uses it meanwhile, weft calls these around every submission, and the host locks likewise; both or none.
    /// They are not called one within the other, and must not throw.
    std::function<void()> lock_queue = {}, unlock_queue = {};
};

/// As Simulation::load and Simulation::create, on the host's device. Options name the backend "vulkan" or "auto", and
/// no device. Fails with every handle that is null, an API older than 1.2, a physical device that is none of the
/// instance's or will not do, a queue family that does not compute, a lock without its counterpart.
WEFT_API Result<Simulation> load_on(const VulkanHost& host, const std::filesystem::path& scene,
                                    const Options& options = {});
WEFT_API Result<Simulation> create_on(const VulkanHost& host, const WorldDesc& world = {}, const Options& options = {});

/// What a simulation runs on: the host's, or what weft has made of its own where it was not given one. That may be used
/// as if it were the host's, from the thread that uses the simulation, and lives as long as the simulation does; the
/// device has the three features above and no extensions. Fails where it does not run on Vulkan.
WEFT_API Result<VulkanHost> vulkan_device(const Simulation& simulation);

/// The moment at which a timeline semaphore has reached a value.
struct VulkanMoment {
    VkSemaphore semaphore = VK_NULL_HANDLE;
    std::uint64_t value = 0;
};

/// An array on the device. Where there is none, it has no buffer and no elements.
struct VulkanArray {
    VkBuffer buffer = VK_NULL_HANDLE;
    VkDeviceSize offset = 0;                ///< bytes into the buffer; a multiple of 256
    VkDeviceAddress address = 0;            ///< of the first element: that of the buffer, and offset
    VkFormat format = VK_FORMAT_UNDEFINED;  ///< of an element
    std::uint32_t stride = 0;               ///< bytes from an element to the next
    std::uint32_t count = 0;                ///< elements
};

/// The drawn surface of one cloth. All buffers may be read as vertex, index and storage buffers, by address, and copied
/// from; the host writes to none of them. They belong to the queue family of the simulation's queue.
struct VulkanSurface {
    VulkanArray positions;  ///< R32G32B32A32_SFLOAT: m, and 1; an element per vertex of the mesh as it was loaded
    VulkanArray normals;    ///< R32G32B32A32_SFLOAT: unit, and 0
    VulkanArray tangents;   ///< R32G32B32A32_SFLOAT: as Simulation::tangents() has them; none if the mesh has no UVs
    VulkanArray uvs;        ///< R32G32_SFLOAT; none if the mesh has none
    VulkanArray triangles;  ///< R32G32B32_UINT: three vertices; as an index buffer, 3 · count VK_INDEX_TYPE_UINT32
    VulkanMoment ready;     ///< from here on all of them hold what they should
};

/// The surface of the cloth as it is after the last step or change, made on the device; equal to Simulation::surface()
/// and tangents(), which bring theirs over the CPU. Returns without waiting for the device, but for the first time,
/// when the buffers are made. Asked again before the cloth has changed, it gives the same and does nothing.
///
/// What the host must do:
/// * Wait for `ready` in the submission that reads, or on the CPU with vkWaitSemaphores. No barrier is needed beside
/// it.
/// * Let positions, normals and tangents alone when they are written again. There are two sets of them, which take
///   turns: a call after a step writes the set that the call before the last one gave, so what the last one gave may
///   still be read meanwhile. Reading that was submitted before, to the simulation's queue, weft waits for by itself.
///   Reading on another queue ends before the call, or `before` is the moment at which it will have ended, of a
///   timeline semaphore that work which is already submitted will bring there (or vkSignalSemaphore has): simulation
///   and host wait for it, and where it does not come, for ever. Reads by the CPU of copies concern nobody.
/// * End all reading of a cloth's buffers before the cloth is removed, set_fabric() or set_pins() is called for it,
///   set_solver() is called, or the simulation ends. Then its buffers are destroyed, and the next call makes new ones.
///   Adding and removing other cloths, colliders, restore_state() and everything else leaves them.
///
/// Handles stay the same from one step to the next, up to the two sets; the semaphore is always the same one.
/// Fails, and changes nothing, for an id that names nothing, a simulation that does not run on Vulkan, a device that
/// has no room or is lost.
WEFT_API Result<VulkanSurface> vulkan_surface(Simulation& simulation, ClothId cloth, VulkanMoment before = {});

}  // namespace weft
