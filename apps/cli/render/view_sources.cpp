#ifdef WEFT_VULKAN
#include "cli/render/view_sources.h"

#include "io/images/image_file.h"
#include "io/meshes/mesh_file.h"
#include "weft/drawing_device.h"

namespace weft::cli {
namespace {

template <class Picture>
std::function<Result<Picture>(const std::string&)> beside(const std::filesystem::path& scene,
                                                          Result<Picture> (*read)(const std::filesystem::path&)) {
    return [folder = scene.parent_path(), read](const std::string& file) -> Result<Picture> {
        const auto path = find_asset(file, folder);
        if (!path) return path.errors();
        return read(*path);
    };
}

}  // namespace

ViewSources view_sources(const std::filesystem::path& scene, World& world) {
    return {.surface = surfaces_on_device(world),
            .read_picture = beside<Image8>(scene, [](const auto& path) { return read_image(path); }),
            .read_light = beside<ImageF>(scene, [](const auto& path) { return read_hdr(path); })};
}

}  // namespace weft::cli
#endif
