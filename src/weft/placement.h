// From what a scene says of a cloth to the mesh in the world and the particles that are pinned.
#pragma once

#include "mesh/topology.h"
#include "scene/scene_desc.h"
#include "solver/world/world.h"

#include <weft/result.h>

#include <string>
#include <string_view>
#include <vector>

namespace weft {

/// Scale and up axis of a file, then the scene's transform. `from` is where the mesh came from.
void place_mesh(TriangleMesh& mesh, const MeshDesc& from, const TransformDesc& transform);

struct Pinned {
    ClothPins pins;  ///< all of them, those of `holds` included
    Holds holds;     ///< of pinned particles and anchors
};

/// No id if there is none of that name.
ColliderId find_collider(const World& world, std::string_view name);

/// Which particle a number in a scene means: `none` for what is not simulated. As in Topology.
struct ParticleNumbers {
    std::uint32_t particle_count = 0;
    std::vector<std::uint32_t> of_welded;  ///< by welded vertex, as pins and stitches number them
    std::vector<std::uint32_t> of_vertex;  ///< by vertex of the simulated mesh
};

/// What the pins of a cloth are selected from.
struct PinnedCloth {
    const TriangleMesh& mesh;  ///< simulated
    const ParticleNumbers& numbers;
    std::span<const Vec3> rest_positions = {};  ///< m, per particle; only without `positions`
    std::span<const Vec4> positions;            ///< m, per particle: where it is now; empty: where it is at rest
    double time = 0;                            ///< s
};

/// The particles that pins name; where several pins name one, the last wins. Every pin must name at least one; `where`
/// of an error is a JSON pointer that starts with `pointer`, the place of the pins. Names of colliders have been
/// checked.
Result<Pinned> select_pins(const std::vector<PinDesc>& pins, const PinnedCloth& cloth, const World& world,
                           const std::string& pointer);

}  // namespace weft
