// A triangle mesh to a file that load_mesh() reads as the same mesh.
#pragma once

#include "io/files/atomic_file.h"
#include "mesh/triangle_mesh.h"

#include <weft/result.h>

namespace weft {

/// Binary little-endian PLY with every array that the mesh has, to the bit. The exports' own `.ply` is for other
/// programs: its normals are of unit length and its colors have eight bits. Does not commit.
Result<Done> write_mesh(const TriangleMesh& mesh, AtomicFile& file);

}  // namespace weft
