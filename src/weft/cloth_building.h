// Builds the model of a cloth from its description in a scene.
#pragma once

#include "scene/scene_desc.h"
#include "solver/world/world.h"
#include "weft/cutting.h"
#include "weft/placement.h"

#include <weft/result.h>
#include <weft/simulation.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace weft {

/// How mesh files of a scene are read.
struct MeshFiles {
    MeshReader read = {};               ///< if empty, a cloth with a mesh file is an error
    std::filesystem::path folder = {};  ///< folder of the scene file
};

/// Data that is kept besides a cloth's model, to build another model of the same particles.
struct ClothSource {
    std::shared_ptr<const TriangleMesh> simulated = {};  ///< in world space; null if it is the drawn mesh
    TopologyOptions topology = {};
    std::shared_ptr<const ParticleNumbers> numbers = {};
    ClothPins pins = {};
    std::vector<PlannedCut> cuts = {};
    std::uint64_t serial = 0;  ///< of the cloth in its SceneWorld; another cloth has another one
};

struct BuiltCloth {
    std::shared_ptr<const ClothModel> model;
    KinematicTargets targets;
    ClothSource source;
};

/// Reads or generates the meshes of a cloth and builds its model. The cloth must have been checked, and its colliders
/// must be in `world`. `pointer`: the place of the cloth in errors. Appends one line per warning to `notes`.
Result<BuiltCloth> build_cloth(const SceneCloth& cloth, const MeshFiles& files, const World& world,
                               const std::string& pointer, std::vector<std::string>& notes);

/// A model of the same particles with the resistance of `cloth`. `model`: of a cloth that tears by itself. `pointer`:
/// the place of the cloth in errors.
Result<std::shared_ptr<const ClothModel>> with_resistance(const ClothModel& model, const ClothSource& source,
                                                          const SceneCloth& cloth, const std::string& pointer);

/// The cloth's fabric with its tether settings, which the solver treats as part of the fabric.
Fabric fabric_of(const SceneCloth& cloth);

/// The simulated mesh at the start, in world space.
const TriangleMesh& simulated_mesh(const ClothModel& model, const ClothSource& source);

/// The number in the model, before any edit, of a triangle of the simulated mesh. Fails if the mesh has no such
/// triangle, or if it is not simulated.
Result<std::uint32_t> find_triangle(std::uint32_t number, const ClothModel& model, const ClothSource& source);

/// Builds a model with the fabric, the weights and the self-collision of `cloth`, and other pins or another layout, for
/// the particles of `now`.
Result<std::shared_ptr<const ClothModel>> rebuild_cloth(const ClothModel& now, const ClothSource& source,
                                                        const SceneCloth& cloth, const ClothPins& pins,
                                                        const ClothLayout& layout);

/// Room for what can part in `cloth`.
ClothReserve reserve_of(const SceneCloth& cloth, std::uint32_t particles);

/// Whether a cloth that has not been cut can get another tearing while it moves: rebuild_with_tearing(). `cloth`: as it
/// is now.
bool gets_room_while_it_moves(const SceneCloth& cloth, const ClothModel& model);

/// Builds a model with the tearing of `cloth`, but without its resistance, for the particles of `now`, and gives
/// `source` its numbers. `now`: of a cloth of which gets_room_while_it_moves() is true.
Result<std::shared_ptr<const ClothModel>> rebuild_with_tearing(const ClothModel& now, ClothSource& source,
                                                               const SceneCloth& cloth, const ClothLayout& layout);

/// Selects the particles of `pins` at their current positions.
Result<Pinned> select_pins_now(const World& world, ClothId id, const ClothSource& source,
                               const std::vector<PinDesc>& pins);

}  // namespace weft
