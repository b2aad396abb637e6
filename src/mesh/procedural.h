// Procedural meshes: grids, spheres and boxes.
#pragma once

#include "mesh/triangle_mesh.h"

#include <weft/scene.h>

#include <array>

namespace weft {

/// A flat sheet centered in the xz plane, facing +y. u grows along +x (the warp) and v along -z, so that an image is
/// not mirrored on the side that faces +y. Vertex (ix, iz) is iz·resolution[0] + ix; the middle vertices of `cross`
/// follow, (cx, cz) at cz·(resolution[0]-1) + cx.
/// `size` in m along x and z, > 0; `resolution` counts vertices along x and z, each at least 2.
TriangleMesh make_grid(std::array<float, 2> size, std::array<std::uint32_t, 2> resolution, GridDiagonal diagonal);

/// A sphere around the origin: an icosahedron, two of its corners on the y axis, whose triangles are cut into four
/// `subdivisions` times. Triangles differ in area by less than a third. 10·4ⁿ + 2 vertices, the corners first and then
/// those of each cut; normals, no UVs (any would have a seam and two poles). `radius` in m, > 0; `subdivisions` 0…12.
TriangleMesh make_sphere(float radius, std::uint32_t subdivisions);

/// A box around the origin. `resolution` counts vertices along x, y and z, each at least 2; faces share the vertices of
/// the box's edges. Vertices are ordered layer by layer from the bottom up, within a layer row by row along z, within a
/// row along x. The diagonals of the cells alternate like a checkerboard. No UVs or normals: a shared vertex has no
/// unique one. `size` in m, > 0.
TriangleMesh make_box(std::array<float, 3> size, std::array<std::uint32_t, 3> resolution);

}  // namespace weft
