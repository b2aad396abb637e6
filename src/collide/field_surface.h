// The surface of a distance field as triangles, for looking at it.
#pragma once

#include "collide/shape_data.h"
#include "mesh/triangle_mesh.h"

#include <cstdint>

namespace weft {

/// m: size of a cell of a distance field. `data`: of a mesh, as build_distance_field() makes it.
float cell_of_field(const ShapeData& data);

/// Where the field is zero, in the collider's frame, with normals that point outward. Every vertex is where the
/// distance that contact uses (mesh.kernel.h) changes its sign on an edge of a tetrahedron; each cell consists of six
/// (marching tetrahedra: Doi and Koide 1991, "An Efficient Method of Triangulating Equi-Valued Surfaces by Using
/// Tetrahedral Cells"). Closed, without cracks between bricks. Empty if the field has no inside.
///
/// `most_cells`: if more cells contain zero, blocks of 2, 4 or 8 cells along each axis take the place of cells. The
/// vertices are still where the field is zero, but parts thinner than a block may be missing.
TriangleMesh zero_surface_of_field(const ShapeData& data, std::uint32_t most_cells = 400'000);

}  // namespace weft
