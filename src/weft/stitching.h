// From rows of stitches as a scene says them to ties between particles.
#pragma once

#include "solver/world/world.h"
#include "weft/cloth_building.h"

#include <weft/scene.h>

#include <string>

namespace weft {

/// A cloth that stitches may name.
struct SewnCloth {
    ClothId id;
    const ClothModel& model;
    const ClothSource& source;
};

/// One stitch for each pair of points. The row has been checked (check.h). Fails on vertices and triangles that the
/// meshes have not or that are not simulated; `pointer` is the place of the row in errors.
Result<std::vector<Stitch>> make_stitches(const StitchDesc& row, const SewnCloth& a, const SewnCloth& b,
                                          const std::string& pointer);

}  // namespace weft
