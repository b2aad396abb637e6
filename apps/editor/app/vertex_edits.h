// What a scene says after pins and groups of vertices have changed.
#pragma once

#include "editor/core/document.h"
#include "editor/tools/vertex_sets.h"

#include <string>
#include <string_view>
#include <vector>

namespace weft::editor {

// `cloth`: its place, such as `/cloths/0`. It must exist.

/// A new pin of these vertices. Names the group that lists exactly them.
std::vector<Edit> pin_edits(const Document& document, const std::string& cloth, const VertexSet& vertices);

struct PinChange {
    std::vector<Edit> edits;  ///< none: nothing changes
    std::size_t others = 0;   ///< pins by box or color, which do not list vertices
};
/// Pins some vertices and lets go of others. Added vertices join the last pin that does nothing but list vertices. A
/// pin by a group that loses a part of it lists the rest.
PinChange changed_pins(const Document& document, const std::string& cloth, const VertexSet& add,
                       const VertexSet& remove);

/// The vertices that pins list, themselves or by a group.
VertexSet listed_pins(const Document& document, const std::string& cloth);

// --- Groups

std::vector<std::string> group_names(const Document& document, const std::string& cloth);
/// Null if there is none of that name.
const VertexGroup* find_group(const Document& document, const std::string& cloth, std::string_view name);
/// `name` with a number behind it if it is taken.
std::string free_group_name(const Document& document, const std::string& cloth, const std::string& name);
/// The group gets these vertices. It is made if there is none of that name.
std::vector<Edit> group_edits(const Document& document, const std::string& cloth, const std::string& name,
                              const VertexSet& vertices);
/// Also where pins and resistance name it.
std::vector<Edit> group_renaming(const Document& document, const std::string& cloth, const std::string& name,
                                 const std::string& now);
/// Pins and resistance that name it list its vertices from then on.
std::vector<Edit> group_removal(const Document& document, const std::string& cloth, const std::string& name);

}  // namespace weft::editor
