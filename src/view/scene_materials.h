// The materials of a scene's objects on the device, with the images that they name.
#pragma once

#include "render/renderer.h"
#include "view/scene_view.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace weft {

/// Objects with equal materials share one.
class SceneMaterials {
  public:
    explicit SceneMaterials(ReadPicture read) : read_(std::move(read)) {}

    /// Gives the cloth or collider `name` this material. `of`: the one that it has, if any. Waits for the frames in
    /// flight if they may use what changes.
    Result<void> set(render::Renderer& renderer, std::optional<render::MaterialId>& of, const std::string& name,
                     const Material& material, std::vector<std::string>& notes);
    /// The object is gone. No frame may be in flight.
    void release(render::Renderer& renderer, std::optional<render::MaterialId>& of);

  private:
    struct Used {
        Material material;
        std::size_t objects = 0;  ///< that have it
    };

    Result<render::MaterialId> add(render::Renderer& renderer, const std::string& name, const Material& material,
                                   std::vector<std::string>& notes);
    /// Null if there is no such image. A file that cannot be read causes a single note, which ends with `instead`.
    const Image8* picture(const std::string& file, const std::string& name, const std::string& instead,
                          std::vector<std::string>& notes);

    ReadPicture read_;
    std::map<render::MaterialId, Used> used_;
    std::map<std::string, std::optional<Image8>> pictures_;
};

/// A checkerboard of two grays. It shows that an image is missing, and how the UVs are laid out.
Image8 checkered();

}  // namespace weft
