#include "io/meshes/mesh_checks.h"

namespace weft {

std::string problem_of_stl(std::string_view content) {
    // A binary file has 84 bytes plus 50 per facet, and may also begin with "solid".
    constexpr std::size_t header = 84, facet = 50;
    std::size_t facets = 0;
    for (std::size_t b = header; b-- > header - 4 && content.size() >= header;) {
        facets = facets << 8 | static_cast<unsigned char>(content[b]);
    }
    if (content.size() >= header && content.size() == header + facet * facets) return {};
    const std::size_t last_facet = content.rfind("facet");
    if (last_facet == std::string_view::npos) return {};  // not a text STL: Assimp reports what it is
    return content.find("endsolid", last_facet) == std::string_view::npos ? "is cut short: it has no endsolid" : "";
}

}  // namespace weft
