// From what a scene says of a cloth to the mesh in the world and the particles that are pinned.
#pragma once

#include "mesh/topology.h"
#include "scene/scene_desc.h"

#include <weft/result.h>

#include <string>
#include <vector>

namespace weft {

/// Scale and up axis of the file, then the scene's transform.
void place_mesh(TriangleMesh& mesh, const ClothDesc& cloth);

/// The particles that a cloth's pins name. Every pin must name at least one; `where` of an error is a JSON pointer that
/// starts with `pointer`, the place of the cloth.
Result<std::vector<std::uint32_t>> select_pins(const ClothDesc& cloth, const TriangleMesh& mesh,
                                               const Topology& topology, const std::string& pointer);

}  // namespace weft
