// The Vulkan device that draws a simulation: the device that runs it, or a separate one.
#pragma once

#ifdef WEFT_VULKAN
#include "gpu/surface_buffers.h"
#include "solver/world/world.h"

#include <weft/ids.h>
#include <weft/result.h>

#include <functional>
#include <memory>
#include <string>

namespace weft {

/// Returns the device of the world's backend if that is Vulkan. Otherwise creates a device: the one that `name`
/// selects, or the best one, including software devices.
Result<std::shared_ptr<gpu::Device>> drawing_device(World& world, const std::string& name);

/// Returns a function that computes the render mesh of a cloth on the device of the world's backend; empty if the
/// backend is not Vulkan. The function keeps a reference to the world, which must not be moved.
std::function<Result<gpu::SurfaceBuffers>(ClothId cloth)> surfaces_on_device(World& world);

}  // namespace weft
#endif
