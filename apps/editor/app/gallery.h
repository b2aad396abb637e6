// The dialog that shows the scenes that come with the program, with images of them.
#pragma once

#include "editor/app/scene_files.h"
#include "editor/app/thumbnails.h"
#include "editor/ui/ui.h"
#include "editor/ui/ui_renderer.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

namespace weft::editor {

class Gallery {
  public:
    /// Draws the dialog. Images that are missing are made meanwhile, in other processes. Returns the scene that was
    /// chosen.
    std::optional<std::filesystem::path> show(Ui& ui, UiRenderer& renderer, bool& open);

  private:
    void start();
    bool tile(Ui& ui, std::size_t scene, float width) const;

    std::vector<GalleryScene> scenes_;
    std::vector<UiImage> images_;  ///< per scene; none: there is none yet
    std::unique_ptr<Thumbnails> thumbnails_;
};

}  // namespace weft::editor
