// The materials of a scene's objects, with the images that they name.
#pragma once

#include "render/renderer.h"
#include "view/scene_view.h"

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace weft {

class SceneMaterials {
  public:
    explicit SceneMaterials(ReadPicture read) : read_(std::move(read)) {}

    /// The material of the cloth or collider `name`. Created on first use.
    Result<render::MaterialId> find(render::Renderer& renderer, const std::string& name, const Material& material,
                                    std::vector<std::string>& notes);

    /// Frees all other materials. No frame may be in flight.
    void keep(render::Renderer& renderer, std::span<const render::MaterialId> used);

  private:
    /// Null if there is no such image. A file that cannot be read causes a single note, which ends with `instead`.
    const Image8* picture(const std::string& file, const std::string& name, const std::string& instead,
                          std::vector<std::string>& notes);

    ReadPicture read_;
    std::map<std::string, render::MaterialId> ids_;
    std::map<std::string, std::optional<Image8>> pictures_;
};

/// A checkerboard of two grays. It shows that an image is missing, and how the UVs are laid out.
Image8 checkered();

}  // namespace weft
