// Places the mesh of a cloth in the world and selects its pinned particles.
#pragma once

#include "mesh/topology.h"
#include "scene/scene_desc.h"
#include "solver/world/world.h"

#include <weft/result.h>

#include <string>
#include <string_view>
#include <vector>

namespace weft {

/// Applies scale and up axis of a mesh file, then the transform of the cloth. `from`: the description of the mesh.
void place_mesh(TriangleMesh& mesh, const MeshDesc& from, const TransformDesc& transform);

struct Pinned {
    ClothPins pins;            ///< all pins, including those with targets
    KinematicTargets targets;  ///< of moving pinned particles and anchors
};

/// Returns a null id if no collider has this name.
ColliderId find_collider(const World& world, std::string_view name);

/// Maps numbers in a scene to particles; `none`: not simulated. As in Topology.
struct ParticleNumbers {
    std::uint32_t particle_count = 0;
    std::vector<std::uint32_t> of_welded;  ///< by welded vertex, as pins and stitches number them
    std::vector<std::uint32_t> of_vertex;  ///< by vertex of the simulated mesh
    std::uint32_t first_anchor = 0;        ///< of the cloth's model
};

/// The cloth whose pins are selected.
struct PinnedCloth {
    const TriangleMesh& mesh;  ///< simulated mesh
    const ParticleNumbers& numbers;
    std::span<const Vec3> rest_positions = {};  ///< m, per particle; used if `positions` is empty
    std::span<const Vec4> positions;            ///< m, per particle: current positions; empty: at rest
    /// Per copy of a particle, made by cuts and tears: the particle that was copied. Copies follow all other particles.
    std::span<const std::uint32_t> copied_from = {};
    double time = 0;  ///< s
};

/// Selects particles of a cloth at rest. Fails if there are none.
Result<std::vector<std::uint32_t>> select_particles(const std::variant<VertexPins, BoxPins, ColorPins>& select,
                                                    const PinnedCloth& cloth, const std::string& pointer);

/// Selects the particles of the pins. Vertices and colors select the copies of a particle too; a box selects each by
/// its own position. If several pins select a particle, the last one counts. Fails if a pin selects none. `where` of an
/// error is a JSON pointer that starts with `pointer`, the place of the pins. Names of colliders must have been
/// checked.
Result<Pinned> select_pins(const std::vector<PinDesc>& pins, const PinnedCloth& cloth, const World& world,
                           const std::string& pointer);

}  // namespace weft
