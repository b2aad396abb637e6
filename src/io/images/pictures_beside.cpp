#include "io/images/pictures_beside.h"

#include "io/images/image_file.h"
#include "io/meshes/mesh_file.h"

namespace weft {
namespace {

template <class Picture>
std::function<Result<Picture>(const std::string&)> reader_beside(
    const std::filesystem::path& folder, Result<Picture> (*read)(const std::filesystem::path&)) {
    return [folder, read](const std::string& file) -> Result<Picture> {
        const auto path = find_asset(file, folder);
        if (!path) return path.errors();
        return read(*path);
    };
}

}  // namespace

std::function<Result<Image8>(const std::string&)> pictures_beside(const std::filesystem::path& folder) {
    return reader_beside<Image8>(folder, [](const auto& path) { return read_image(path); });
}

std::function<Result<ImageF>(const std::string&)> lights_beside(const std::filesystem::path& folder) {
    return reader_beside<ImageF>(folder, [](const auto& path) { return read_hdr(path); });
}

}  // namespace weft
