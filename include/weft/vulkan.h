// Simulates on the Vulkan device of a host program. The host draws from the buffers that the simulation fills, without
// copies to the CPU. This is the only header of weft that includes Vulkan's headers.
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

/// The Vulkan handles that a host shares with weft. The host keeps ownership: weft destroys none of them, and all of
/// them must outlive the simulation.
///
/// The host must create the instance for Vulkan 1.2 or later, and the device with the features bufferDeviceAddress,
/// timelineSemaphore and hostQueryReset of VkPhysicalDeviceVulkan12Features (or of the structure of each feature). weft
/// checks what the physical device supports. It cannot check which features are enabled, as Vulkan has no query for it.
struct VulkanHost {
    VkInstance instance = VK_NULL_HANDLE;
    VkPhysicalDevice physical_device = VK_NULL_HANDLE;  ///< of this instance
    VkDevice device = VK_NULL_HANDLE;
    VkQueue queue = VK_NULL_HANDLE;  ///< of `queue_family`, created without flags
    std::uint32_t queue_family = 0;  ///< supports compute, and graphics if the host draws on this queue
    /// The VkApplicationInfo::apiVersion of the instance; VK_API_VERSION_1_2 or later.
    std::uint32_t api_version = VK_API_VERSION_1_2;
    /// Loads the host's Vulkan functions; null: weft uses the system's loader (libvulkan.so.1).
    PFN_vkGetInstanceProcAddr get_instance_proc_addr = nullptr;
    /// weft uses the queue only during calls of the simulation's functions, on the calling thread. If another thread
    /// uses the queue at the same time, set both functions: weft calls them around every submission, and the host must
    /// hold the same lock around its own. Calls are never nested. The functions must not throw.
    std::function<void()> lock_queue = {}, unlock_queue = {};
};

/// Like Simulation::load and Simulation::create, on the host's device. Options::backend must be "vulkan" or "auto", and
/// Options::device must be empty. Fails on a null handle, an API version below 1.2, a physical device that does not
/// belong to the instance or lacks a required feature, a queue family without compute, and a lock function without the
/// other one.
WEFT_API Result<Simulation> load_on(const VulkanHost& host, const std::filesystem::path& scene,
                                    const Options& options = {});
WEFT_API Result<Simulation> create_on(const VulkanHost& host, const WorldDesc& world = {}, const Options& options = {});

/// The handles that a simulation runs on: those of the host, or those that weft created. Handles that weft created may
/// be used as if the host had created them, on the thread that uses the simulation, as long as the simulation exists.
/// Their device has the three features above and no extensions. Fails if the simulation does not run on Vulkan.
WEFT_API Result<VulkanHost> vulkan_device(const Simulation& simulation);

/// The point at which a timeline semaphore has reached a value.
struct TimelinePoint {
    VkSemaphore semaphore = VK_NULL_HANDLE;
    std::uint64_t value = 0;
};

/// An array on the device. An array that does not exist has a null buffer and no elements.
struct VulkanArray {
    VkBuffer buffer = VK_NULL_HANDLE;
    VkDeviceSize offset = 0;                ///< bytes into the buffer; a multiple of 256
    VkDeviceAddress address = 0;            ///< of the first element: address of the buffer + offset
    VkFormat format = VK_FORMAT_UNDEFINED;  ///< of an element
    std::uint32_t stride = 0;               ///< bytes from one element to the next
    std::uint32_t count = 0;                ///< elements
};

/// The render mesh of one cloth. The host may use all buffers as vertex, index and storage buffers and as the source of
/// copies, and read them by address; it must not write to them. They belong to the queue family of the simulation's
/// queue.
struct VulkanSurface {
    VulkanArray positions;  ///< R32G32B32A32_SFLOAT: m, w is 1; one per vertex of the mesh as loaded
    VulkanArray normals;    ///< R32G32B32A32_SFLOAT: unit, w is 0
    VulkanArray tangents;   ///< R32G32B32A32_SFLOAT: like Simulation::tangents(); none if the mesh has no UVs
    VulkanArray uvs;        ///< R32G32_SFLOAT; none if the mesh has no UVs
    VulkanArray triangles;  ///< R32G32B32_UINT; as an index buffer, 3 · count of VK_INDEX_TYPE_UINT32
    TimelinePoint ready;    ///< when reached, all arrays are written
};

/// Computes on the device the surface of the cloth after the last step or change. The values equal those of
/// Simulation::surface() and tangents(), which copy theirs to the CPU. Only the first call for a cloth waits for the
/// device, to create the buffers. A second call before the cloth has changed only returns the same arrays.
///
/// Rules for the host:
/// * Wait for `ready` in the submission that reads, or on the CPU with vkWaitSemaphores. No other barrier is needed.
/// * Do not read positions, normals and tangents while they are overwritten. There are two alternating sets of them: a
///   call after a step overwrites the set that the call before the last one returned, so the set that the last call
///   returned can still be read. weft waits for reads that were submitted to the simulation's queue before the call.
///   Reads on another queue must end before the call, or `before` must be the point at which they end. The semaphore
///   must reach this value by work that is already submitted, or by an earlier vkSignalSemaphore. Simulation and host
///   wait for the value, forever if it is never reached. CPU reads of copies need no synchronization.
/// * End all reads of a cloth's buffers before removing the cloth, before set_fabric() or set_pins() for this cloth,
///   before set_solver(), and before destroying the simulation. These calls destroy the buffers, and the next call of
///   vulkan_surface() creates new ones. All other calls keep them, among them adding and removing other cloths and
///   colliders, and restore_state().
///
/// Handles stay the same from step to step, apart from the two sets. The semaphore is always the same.
/// Fails and changes nothing if the id names nothing, the simulation does not run on Vulkan, or the device is out of
/// memory or lost.
WEFT_API Result<VulkanSurface> vulkan_surface(Simulation& simulation, ClothId cloth, TimelinePoint before = {});

}  // namespace weft
