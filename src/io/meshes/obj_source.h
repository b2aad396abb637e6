// What Assimp does not tell about an OBJ file: the numbers of its `v` lines.
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
    std::vector<Vec4> colors;     ///< empty, or one per `v` line: white for those that give none
    /// The geometry alone (`v`, `vt`, `vn` and `f` lines) in one spelling, because Assimp overlooks lines that are
    /// indented and numbers that begin with a point, with every `v` line's color replaced by its number. Assimp passes
    /// a vertex's color through untouched, so each of the corners that it emits names its `v` line.
    std::string tagged;
};

/// Fails, naming file and line, on lines that are not finite numbers and on faces that use lines that do not exist.
Result<ObjSource> read_obj_source(std::string_view text, const std::string& file);

/// The number of the `v` line that a color in ObjSource::tagged stands for.
std::uint32_t obj_vertex_from_tag(float red, float green);

}  // namespace weft
