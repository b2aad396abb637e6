// Writes a triangle mesh to a file that load_mesh() reads as the same mesh.
#pragma once

#include "io/files/atomic_file.h"
#include "mesh/triangle_mesh.h"

#include <weft/result.h>

namespace weft {

/// Binary little-endian PLY with all arrays of the mesh, bit for bit. In contrast, the `.ply` export is for other
/// programs: its normals have unit length and its colors eight bits. Does not commit the file.
Result<void> write_mesh(const TriangleMesh& mesh, AtomicFile& file);

}  // namespace weft
