// Reading of mesh files. Part of the library weft::io.
#pragma once

#include <weft/export.h>
#include <weft/mesh.h>
#include <weft/result.h>

#include <filesystem>
#include <string>

namespace weft {

/// Reads a triangle mesh from an OBJ, PLY, glTF, GLB, FBX, STL or 3DS file. A relative name is searched in `folder`,
/// then in the folders of the environment variable WEFT_ASSETS (separated by ':'), then where Debian's packages install
/// models. Fails if no file is found or it cannot be read. It is the default Options::read_mesh of Simulation::load.
WEFT_API Result<TriangleMesh> read_mesh_file(const std::string& file, const std::filesystem::path& folder);

}  // namespace weft
