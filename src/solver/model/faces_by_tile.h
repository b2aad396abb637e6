// The triangles of a cloth, ordered by tiles of particles: contact with colliders looks for them there.
#pragma once

#include "base/aligned.h"
#include "mesh/triangle_view.h"

#include <cstdint>
#include <vector>

namespace weft {

/// A tile is lane_padding particles. A triangle belongs to the tile of its first particle, the one with the lowest
/// number.
struct FacesByTile {
    std::vector<std::uint32_t> begin = {0};  ///< per tile: its first triangle in `corners`; then the end
    std::uint32_t most_in_tile = 0;          ///< triangles
    std::uint32_t stride = 0;                ///< padded, and at least lane_padding more than the last triangle
    std::vector<std::uint32_t> place;        ///< of each triangle in `corners`; `none` for a removed one
    AlignedVector<std::uint32_t> corners;    ///< [corner · stride + triangle]; padding has corners 0
};

/// Leaves out removed triangles, whose corners are all the same.
FacesByTile lay_out_by_tile(const TriangleView& triangles, std::uint32_t particles);

}  // namespace weft
