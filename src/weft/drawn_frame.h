// The render meshes of a frame, as exporters read them.
#pragma once

#include "look/drawn_surface.h"
#include "scene/scene_desc.h"
#include "solver/state/frame.h"

#include <span>
#include <vector>

namespace weft {

/// The surfaces of a frame's cloths, with their materials.
class DrawnFrame {
  public:
    /// Sets the surfaces. They point into `frame` and into the materials of `cloths`, which are found by name. A cloth
    /// without a material is drawn with the vertex colors of its mesh, or, without colors, with the material of its
    /// fabric.
    void update(const Frame& frame, std::span<const SceneCloth> cloths = {});
    std::span<const DrawnSurface> surfaces() const { return surfaces_; }

  private:
    std::vector<DrawnSurface> surfaces_;
};

}  // namespace weft
