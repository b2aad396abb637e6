// Reads the `v` lines of an OBJ file, because Assimp does not report their numbers.
#pragma once

#include <weft/result.h>
#include <weft/vector.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace weft {

struct ObjSource {
    std::vector<Vec3> positions;  ///< one per `v` line, in their order
    std::vector<Vec4> colors;     ///< empty, or one per `v` line: white for lines without a color
    /// Only the geometry (`v`, `vt`, `vn` and `f` lines), normalized because Assimp overlooks indented lines and
    /// numbers that begin with a point. The color of every `v` line is replaced by the line's number. Assimp passes
    /// vertex colors through unchanged, so each of its corners identifies its `v` line.
    std::string tagged;
};

/// Fails, naming file and line, on values that are not finite numbers and on faces that use missing lines.
Result<ObjSource> read_obj_source(std::string_view text, const std::string& file);

/// Decodes the number of the `v` line from a color in ObjSource::tagged.
std::uint32_t obj_vertex_from_tag(float red, float green);

}  // namespace weft
