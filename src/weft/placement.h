// From what a scene says of a cloth to the mesh in the world and the particles that are pinned.
#pragma once

#include "mesh/topology.h"
#include "scene/scene_desc.h"
#include "solver/world.h"

#include <weft/result.h>

#include <string>
#include <vector>

namespace weft {

/// Scale and up axis of a file, then the scene's transform. `from` is where the mesh came from.
void place_mesh(TriangleMesh& mesh, const MeshDesc& from, const TransformDesc& transform);

struct Pinned {
    std::vector<std::uint32_t> particles;  ///< all of them, those of `holds` included
    std::vector<Attachment> attachments;   ///< pins that give way; the particles keep their weight
    Holds holds;                           ///< of pinned particles and anchors
};

/// The particles that a cloth's pins name in the simulated mesh; where several pins name one, the last wins. Every pin
/// must name at least one; `where` of an error is a JSON pointer that starts with `pointer`, the place of the cloth.
/// Names of colliders have been checked.
Result<Pinned> select_pins(const ClothDesc& cloth, const TriangleMesh& mesh, const Topology& topology,
                           const World& world, const std::string& pointer);

}  // namespace weft
