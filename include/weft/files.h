// Files: what Simulation::load reads meshes with. In the library weft::io.
#pragma once

#include <weft/export.h>
#include <weft/mesh.h>
#include <weft/result.h>

#include <filesystem>
#include <string>

namespace weft {

/// Reads a triangle mesh: OBJ, PLY, glTF, FBX, STL or 3DS. A relative name is looked for in `folder`, then in the
/// folders of the environment variable WEFT_ASSETS, then where Linux packages put models. For Options::read_mesh.
WEFT_API Result<TriangleMesh> read_mesh_file(const std::string& file, const std::filesystem::path& folder);

}  // namespace weft
