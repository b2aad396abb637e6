// Small scenes for pictures: a cloth laid over a ball, in every material, with every overlay, in every light.
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

struct PictureScene {
    std::string name;
    std::string look = "\"cotton\"", light = "{}";  ///< JSON, of the cloth and of the scene
    std::vector<std::string> overlays = {};
    bool transparent = false;
    bool environment = false;  ///< surroundings made in code
    bool hung = false;         ///< by two corners in a wind, against the ball
    std::uint32_t samples = 4;
};
void PrintTo(const PictureScene& scene, std::ostream* out);

const std::vector<PictureScene>& picture_scenes();

/// As scene files have it; left in golden/ of the build, so that `weft render` can show it.
std::string scene_text(const PictureScene& scene);

/// Blue above, dark below, a warm window on one side: what is seen in it can be told.
ImageF window_light();

/// A device under the validation layers, and scenes drawn on it.
class PictureTest : public gpu::OnDevice {
  protected:
    void SetUp() override;
    /// Simulated by the CPU, whose results have the same bits everywhere; 160 by 90 pixels, 320 by 180 where it hangs.
    Image8 drawn(const PictureScene& scene);
};

}  // namespace weft
