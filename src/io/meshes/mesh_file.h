// Triangle meshes from files, through Assimp.
#pragma once

#include "mesh/triangle_mesh.h"

#include <weft/result.h>

#include <filesystem>
#include <span>
#include <string_view>

namespace weft {

/// Reads OBJ, PLY, glTF/GLB, FBX, STL and 3DS: every triangle of every object in the file, with the transforms of its
/// nodes applied, polygons cut into triangles, points and lines left out, and UVs (v up), normals and vertex colors
/// where the file has them. Normals are kept only if every vertex in use has one; those of STL, one per triangle, never
/// are.
///
/// Vertices come in the order of the file, identical ones joined, those that no face uses included. For OBJ that is the
/// order of its `v` lines, each line at least one vertex; FBX, STL and 3DS come in the order in which faces first use
/// them. Units and axes are the file's own.
///
/// Fails, naming the file, on a missing, empty, truncated or unreadable file, one without a triangle, non-finite
/// coordinates and indices out of range.
Result<TriangleMesh> load_mesh(const std::filesystem::path& path);

/// Where a mesh named in a scene is: as given if absolute; else beside the scene, then along the environment variable
/// WEFT_ASSETS (folders separated by ':'), then in the folders where the system's packages put models. The error lists
/// every place that was tried.
Result<std::filesystem::path> find_asset(std::string_view file, const std::filesystem::path& scene_folder);

/// Endings that load_mesh reads, with the dot, lower case.
std::span<const std::string_view> mesh_formats();

}  // namespace weft
