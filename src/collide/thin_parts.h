// Finds parts of a solid that are too thin for a grid.
#pragma once

#include "base/workers.h"

#include <weft/vector.h>

#include <cstdint>
#include <span>
#include <vector>

namespace weft {

class SolidSurface;

struct ThinParts {
    std::uint32_t samples = 0;  ///< points of the surface that were examined, about one per cell that it passes through
    std::uint32_t thin = 0;     ///< points at which the solid is thinner than two cells
    float least_thickness = 0;  ///< the least of theirs; 0 if there are none
    Vec3 place{};               ///< the point of the surface that has it
};

/// A point of the surface.
struct SurfaceSample {
    Vec3 position;
    std::uint32_t triangle;
};

/// Points of the triangles, neighbors on a triangle at most about one unit apart. Keeps those for which claim(position)
/// returns true; it is called in a fixed order.
std::vector<SurfaceSample> sample_surface(const SolidSurface& surface, FunctionRef<bool(Vec3)> claim);

/// Lengths are in units of a cell. The solid is thin at a sample if the point one cell below it is nearest to a point
/// of the surface that faces the other way (by more than 120 degrees, so that edges and corners of thick parts do not
/// count), with the solid between both and none beyond them. Then a ball of two cells does not fit into the solid
/// there.
ThinParts find_thin_parts(const SolidSurface& surface, std::span<const SurfaceSample> samples, WorkerTeam& team);

}  // namespace weft
