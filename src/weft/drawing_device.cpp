#include "weft/drawing_device.h"

#ifdef WEFT_VULKAN
#include "vulkan/interop.h"

namespace weft {

Result<std::shared_ptr<gpu::Device>> drawing_device(World& world, const std::string& name) {
    if (const auto* interop = dynamic_cast<const VulkanInterop*>(&world.backend())) return interop->shared_device();
    return make_vulkan_device({.device = name});
}

std::function<Result<gpu::SurfaceBuffers>(ClothId cloth)> surfaces_on_device(World& world) {
    auto* interop = dynamic_cast<VulkanInterop*>(&world.backend());
    if (!interop) return {};
    return [interop, &world](ClothId cloth) { return interop->surface(world.handle(cloth)); };
}

}  // namespace weft
#endif
