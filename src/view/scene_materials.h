// The materials of a scene's things, with the pictures that they name.
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

    /// Of a cloth or collider by its name; made once.
    Result<render::MaterialId> find(render::Renderer& renderer, const std::string& name, const Material& material,
                                    std::vector<std::string>& notes);

    /// Frees the others. Nothing is being drawn.
    void keep(render::Renderer& renderer, std::span<const render::MaterialId> used);

  private:
    /// Null if there is none. Of a file that cannot be read there is one note, which ends in `instead`.
    const Image8* picture(const std::string& file, const std::string& name, const std::string& instead,
                          std::vector<std::string>& notes);

    ReadPicture read_;
    std::map<std::string, render::MaterialId> ids_;
    std::map<std::string, std::optional<Image8>> pictures_;
};

/// Squares of two grays, by which one sees that a picture is missing, and how UVs lie.
Image8 checkered();

}  // namespace weft
