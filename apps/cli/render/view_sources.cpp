#ifdef WEFT_VULKAN
#include "cli/render/view_sources.h"

#include "io/images/pictures_beside.h"
#include "weft/drawing_device.h"

namespace weft::cli {

ViewSources view_sources(const std::filesystem::path& scene, World& world) {
    return {.surface = surfaces_on_device(world),
            .read_picture = pictures_beside(scene.parent_path()),
            .read_light = lights_beside(scene.parent_path())};
}

}  // namespace weft::cli
#endif
