// Keeps the values of a distance field in its large cubes below the way that is free.
#pragma once

#include "collide/bvh.h"

#include <weft/bounds.h>

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace weft {

/// The distance to a set of cells, which are unit cubes with corners at whole numbers.
class CellDistance {
  public:
    /// `boxes`: together cover the cells, and nothing else.
    explicit CellDistance(std::vector<Bounds> boxes) : boxes_(std::move(boxes)), tree_(boxes_) {}
    bool empty() const { return boxes_.empty(); }
    /// Infinite if there are no cells.
    double at(Vec3 point) const;

  private:
    std::vector<Bounds> boxes_;
    Bvh tree_;
};

/// Lowers the values at the corners of a cube (corner x + 2 y + 4 z), so that their trilinear interpolation is positive
/// and at every point of the cube at most the distance to the cells. Its gradient keeps its direction.
///   low    corner of the cube; its coordinates are multiples of `side`, which is a power of two, at least 8
///   slack  how much larger a value may become later, by rounding
/// The values must be positive, and the cells at least 1 away from the cube.
std::array<float, 8> lower_to_free_way(const CellDistance& cells, Vec3 low, std::uint32_t side,
                                       std::array<float, 8> values, double slack);

}  // namespace weft
