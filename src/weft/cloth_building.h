// From what a scene says of a cloth to the model that a world runs.
#pragma once

#include "scene/scene_desc.h"
#include "solver/world/world.h"
#include "weft/placement.h"

#include <weft/result.h>
#include <weft/simulation.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace weft {

/// How meshes that a scene names by file are read.
struct MeshFiles {
    MeshReader read = {};  ///< without, a cloth that names a file is refused
    std::filesystem::path folder = {};
};

/// What is kept of a cloth beside its model, to make another model of the same particles.
struct ClothSource {
    std::shared_ptr<const TriangleMesh> simulated = {};  ///< placed; where that is not the mesh that is drawn
    TopologyOptions topology = {};
    ParticleNumbers numbers = {};
    ClothPins pins = {};
};

struct BuiltCloth {
    std::shared_ptr<const ClothModel> model;
    Holds holds;
    ClothSource source;
};

/// Reads or makes the meshes of a cloth that has been checked, and builds its model for a world as it is. `pointer` is
/// the place of the cloth in errors; `notes` gets what building found and survived, a line each.
Result<BuiltCloth> build_cloth(const SceneCloth& cloth, const MeshFiles& files, const World& world,
                               const std::string& pointer, std::vector<std::string>& notes);

/// What a scene says of tethers beside the fabric is a material like any other to the solver.
Fabric fabric_of(const SceneCloth& cloth);

/// As it was placed at the start.
const TriangleMesh& simulated_mesh(const ClothModel& model, const ClothSource& source);

/// Another fabric, other pins or another layout for the particles of `now`.
Result<std::shared_ptr<const ClothModel>> rebuild_cloth(const ClothModel& now, const ClothSource& source,
                                                        const SceneCloth& cloth, const ClothPins& pins,
                                                        const ClothLayout& layout);

/// The particles that `pins` name, where they are now.
Result<Pinned> select_pins_now(const World& world, ClothId id, const ClothSource& source,
                               const std::vector<PinDesc>& pins);

}  // namespace weft
