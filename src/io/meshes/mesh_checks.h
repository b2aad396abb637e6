// What Assimp 5.2 does not check. On a PLY file cut short it reads past its buffer or never returns, and on a face
// without corners it aborts; in PLY, 3DS and glTF it bends or drops faces that use vertices that do not exist; of an
// STL file cut short it takes what is there. On glTF and FBX files whose parts lie in each other very deep, or in
// themselves, it runs out of stack or never returns.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace weft {

/// The first problem with a PLY file: its header, its length, and the vertex numbers in its faces. Empty if none.
std::string problem_of_ply(std::string_view content);

/// The first face of a 3DS file that uses a vertex that does not exist. Empty if none; a broken chunk structure is left
/// to Assimp.
std::string problem_of_3ds(std::string_view content);

/// Whether a text STL file ends before its `endsolid`. Empty if not; binary files are checked by Assimp.
std::string problem_of_stl(std::string_view content);

/// Parts of a glTF or FBX file, text or binary, that lie in each other too deep to be read. Empty if none; what is
/// wrong otherwise is left to Assimp.
std::string problem_of_gltf(std::string_view content);
std::string problem_of_fbx(std::string_view content);

/// How many triangles the scene of a glTF 2 file (text or binary) describes. Nothing if that cannot be told.
std::optional<std::uint64_t> gltf_triangle_count(std::string_view content);

}  // namespace weft
