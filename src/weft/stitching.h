// Converts the stitches of a scene to ties between particles.
#pragma once

#include "solver/world/world.h"
#include "weft/cloth_building.h"

#include <weft/scene.h>

#include <string>

namespace weft {

/// A cloth with stitches.
struct SewnCloth {
    ClothId id;
    const ClothModel& model;
    const ClothSource& source;
};

/// Returns one stitch for each pair of points. `row` must have been checked (check.h). Fails on vertices and triangles
/// that are out of range or not simulated. `pointer`: the place of `row` in errors.
Result<std::vector<Stitch>> make_stitches(const StitchDesc& row, const SewnCloth& a, const SewnCloth& b,
                                          const std::string& pointer);

}  // namespace weft
