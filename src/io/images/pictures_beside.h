// Readers of the images that a scene names.
#pragma once

#include "base/image.h"

#include <weft/result.h>

#include <filesystem>
#include <functional>
#include <string>

namespace weft {

/// Read images of maps, and of light, by the names that a scene gives them: beside the scene, or where find_asset()
/// looks.
std::function<Result<Image8>(const std::string& file)> pictures_beside(const std::filesystem::path& folder);
std::function<Result<ImageF>(const std::string& file)> lights_beside(const std::filesystem::path& folder);

}  // namespace weft
