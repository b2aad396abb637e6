// Small scenes for images: a cloth on a ball with each material, overlay and light.
#pragma once

#include "base/image.h"
#include "files/open_scene.h"
#include "gpu/test_device.h"
#include "view/scene_view.h"

#include <gtest/gtest.h>

#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

namespace weft {

enum class PictureContent {
    laid,    ///< a cloth on a ball
    hung,    ///< hangs by two corners; wind blows it against a ball
    slit,    ///< the same with a slit
    thrown,  ///< two sheets that cross are thrown onto the ground
    tips,    ///< a coarse sheet on a star of a mesh, a corner of a box, and a small ball
    star,    ///< the same star from near, with a plate that its field lacks; the sheet is above
};

struct PictureScene {
    std::string name;
    std::string look = "\"cotton\"", light = "{}";  ///< JSON, of the cloth and of the scene
    std::vector<std::string> overlays = {};
    bool transparent = false;
    bool environment = false;  ///< window_light() in place of a file
    PictureContent content = PictureContent::laid;
    std::uint32_t samples = 4;
};
void PrintTo(const PictureScene& scene, std::ostream* out);

const std::vector<PictureScene>& picture_scenes();

/// A star with six points, and beside it a plate thinner than a cell: a mesh file (OBJ).
std::string star_text();

/// The scene file. The test also writes it to golden/ in the build folder, for `weft render`.
std::string scene_text(const PictureScene& scene);

/// Blue above, dark below, with a warm window on one side, so that orientation is visible.
ImageF window_light();

/// Draws scenes on a device with validation layers.
class PictureTest : public gpu::OnDevice {
  protected:
    void SetUp() override;
    /// Simulates on the CPU, which gives the same bits on every machine. 160 by 90 pixels, or 320 by 180 with overlays.
    Image8 drawn(const PictureScene& scene);
};

}  // namespace weft
