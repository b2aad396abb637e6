// Where a simulation is drawn: on the device that runs it, or on one of its own.
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

/// That of the world's backend where it is Vulkan. Otherwise one is made: the device of that name, or the best there
/// is, a CPU that plays the GPU among them.
Result<std::shared_ptr<gpu::Device>> drawing_device(World& world, const std::string& name);

/// The drawn surface of a cloth where the backend has it on that device; empty where it has none. The world stays where
/// it is.
std::function<Result<gpu::SurfaceBuffers>(ClothId cloth)> surfaces_on_device(World& world);

}  // namespace weft
#endif
