// Sources of the data that a view does not store itself.
#pragma once

#ifdef WEFT_VULKAN
#include "solver/world/world.h"
#include "view/scene_view.h"

#include <filesystem>

namespace weft::cli {

/// Files are searched beside the scene; surfaces come from the world's backend if it has them on a device.
ViewSources view_sources(const std::filesystem::path& scene, World& world);

}  // namespace weft::cli
#endif
