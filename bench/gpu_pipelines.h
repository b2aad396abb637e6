// How long the driver takes to compile the shaders of the Vulkan backend.
#pragma once

#include "gpu/instance.h"

#include <memory>

namespace weft::bench {

/// Compiles every shader without a cache file: one after another, then all again with a thread per processor. Prints
/// the slowest and the sums. Some drivers have a cache of their own, which makes the times too short.
Result<void> print_pipelines(const std::shared_ptr<const gpu::Instance>& instance, const gpu::DeviceInfo& info);

}  // namespace weft::bench
