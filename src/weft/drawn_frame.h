// The drawn surfaces of a frame.
#pragma once

#include "look/drawn_surface.h"
#include "scene/scene_desc.h"
#include "solver/state/frame.h"

#include <span>
#include <vector>

namespace weft {

/// The cloths of a frame as exporters see them.
class DrawnFrame {
  public:
    /// What the surfaces show is the frame's own, and is gone with it. `looks` must stay while surfaces are in use. A
    /// cloth without one is of cotton, or of the colors of its mesh.
    void update(const Frame& frame, std::span<const SceneLook> looks = {});
    std::span<const DrawnSurface> surfaces() const { return surfaces_; }

  private:
    std::vector<DrawnSurface> surfaces_;
};

}  // namespace weft
