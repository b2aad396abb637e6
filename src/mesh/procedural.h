// Meshes made from numbers.
#pragma once

#include "mesh/triangle_mesh.h"

#include <array>

namespace weft {

/// How the cells of a grid are cut. `uniform`: all along +x+z. `alternating`: a checkerboard of both directions.
/// `cross`: both, with one more vertex in the middle of each cell.
enum class GridDiagonal { uniform, alternating, cross };

/// A flat sheet centered in the xz plane, facing +y, u along x (the warp) and v along z. Vertex (ix, iz) is
/// iz·resolution[0] + ix; the middle vertices of `cross` follow, (cx, cz) at cz·(resolution[0]-1) + cx.
/// `size` in m along x and z, > 0; `resolution` counts vertices along x and z, each at least 2.
TriangleMesh make_grid(std::array<float, 2> size, std::array<std::uint32_t, 2> resolution, GridDiagonal diagonal);

}  // namespace weft
