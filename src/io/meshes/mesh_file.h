// Reads triangle meshes from files with Assimp.
#pragma once

#include "mesh/triangle_mesh.h"

#include <weft/result.h>

#include <filesystem>
#include <span>
#include <string_view>

namespace weft {

/// Reads OBJ, PLY, glTF/GLB, FBX, STL and 3DS: all triangles of all objects in the file, with the transforms of its
/// nodes applied, polygons split into triangles, points and lines left out, and UVs (v up), normals and vertex colors
/// where the file has them. Normals are kept only if every vertex in use has one; those of STL, one per triangle, are
/// always dropped.
///
/// Vertices are in the order of the file, including unused ones; identical vertices are joined. For OBJ that is the
/// order of its `v` lines, with at least one vertex per line; for FBX, STL and 3DS the order in which faces first use
/// them. Units and axes are those of the file.
///
/// Fails, naming the file, if it is missing, empty, truncated, unreadable or has no triangle, and on non-finite
/// coordinates and indices out of range.
Result<TriangleMesh> load_mesh(const std::filesystem::path& path);

/// The path of a mesh that a scene names: as given if absolute; otherwise searched beside the scene, then along the
/// environment variable WEFT_ASSETS (folders separated by ':'), then in the folders of the system's model packages. The
/// error lists all places that were tried.
Result<std::filesystem::path> find_asset(std::string_view file, const std::filesystem::path& scene_folder);

/// Endings that load_mesh reads, with the dot, lower case.
std::span<const std::string_view> mesh_formats();

}  // namespace weft
