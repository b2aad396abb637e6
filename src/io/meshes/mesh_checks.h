// Checks that Assimp 5.2 lacks. A truncated PLY file makes it read past its buffer or loop forever, and a face without
// corners makes it abort. In PLY, 3DS and glTF it changes or drops faces that use missing vertices. It accepts
// truncated STL files. glTF and FBX files with deep or cyclic nesting overflow its stack or make it loop forever.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace weft {

/// The first problem with a PLY file: its header, its length, or the vertex numbers of its faces. Empty if none.
std::string problem_of_ply(std::string_view content);

/// The first face of a 3DS file that uses a missing vertex. Empty if none; Assimp checks the chunk structure.
std::string problem_of_3ds(std::string_view content);

/// Reports a text STL file that ends before its `endsolid`. Empty if it is complete; Assimp checks binary files.
std::string problem_of_stl(std::string_view content);

/// Reports parts of a glTF or FBX file, text or binary, that are nested too deep to be read. Empty if there are none;
/// other problems are left to Assimp.
std::string problem_of_gltf(std::string_view content);
std::string problem_of_fbx(std::string_view content);

/// The number of triangles in the scene of a glTF 2 file (text or binary). Nothing if it cannot be determined.
std::optional<std::uint64_t> gltf_triangle_count(std::string_view content);

}  // namespace weft
