// The content of a scene as values in SI units with their defaults, independent of file format and simulation. The
// ranges of the values are in scene_keys.h; check.h applies them. The types that programs use too are in weft/scene.h.
#pragma once

#include "base/transform.h"
#include "look/camera.h"
#include "look/light.h"
#include "look/material.h"
#include "mesh/procedural.h"
#include "scene/fabric.h"

#include <weft/result.h>
#include <weft/scene.h>

#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace weft {

// weft/scene.h must list the kinds of wind in the order of winds.def.
template <class, class... Kinds>
using WindKinds = std::variant<Kinds...>;
#define WEFT_WIND(name, Name) , Name##Desc
static_assert(std::is_same_v<decltype(WindDesc::kind), WindKinds<void
#include "physics/air/winds.def"
                                                                 >>);
#undef WEFT_WIND

/// The material of a cloth or a collider in images and exports.
struct SceneMaterial {
    std::string preset = {};  ///< name of the preset whose values are used where the scene gives none
    Material values = {};
    friend bool operator==(const SceneMaterial&, const SceneMaterial&) = default;
};

/// Vertices with a name, so that pins, resistance and weights can name them.
struct VertexGroup {
    std::string name = {};
    std::vector<std::uint32_t> vertices = {};  ///< welded vertices, as in VertexPins
    friend bool operator==(const VertexGroup&, const VertexGroup&) = default;
};

/// A ClothDesc with its fabric looked up, groups, and a material.
struct SceneCloth {
    std::string name = {};
    MeshDesc mesh = {};                        ///< the simulated mesh
    std::optional<MeshDesc> render_mesh = {};  ///< the drawn mesh, which follows `mesh`; by default the same
    TransformDesc transform = {};
    Vec3 velocity = {};  ///< m/s, at the start
    Fabric fabric = {};
    std::string fabric_name = "cotton";  ///< of the preset that the fabric is based on
    std::vector<VertexGroup> groups = {};
    std::vector<PinDesc> pins = {};
    std::vector<CutDesc> cuts = {};
    std::vector<SeamDesc> seams = {};
    std::vector<ResistanceDesc> resistance = {};
    std::vector<WeightDesc> weights = {};
    Tethers tethers = Tethers::automatic;
    float tether_slack = 0;  ///< relative to the geodesic distance
    SelfCollision self_collision = SelfCollision::off;
    Tearing tearing = Tearing::off;
    float tear_room = 0.125f;  ///< copies of particles, as a fraction of the particles
    std::uint32_t collision_group = 0;
    std::uint32_t collision_mask = ~0u;
    std::uint32_t layer = 0;
    std::optional<SceneMaterial> material = {};  ///< by default that of the fabric
    friend bool operator==(const SceneCloth&, const SceneCloth&) = default;
};

/// A ColliderDesc with a material.
struct SceneCollider : ColliderDesc {
    SceneCollider(ColliderDesc collider = {}) : ColliderDesc(std::move(collider)) {}
    std::optional<SceneMaterial> material = {};  ///< by default `floor` for a plane, `matte` for other shapes
    friend bool operator==(const SceneCollider&, const SceneCollider&) = default;
};

struct SceneDesc {
    std::string name = {};
    Vec3 gravity{0, -9.81f, 0};  ///< m/s²
    float frame_rate = 60;       ///< frames per second, > 0
    SolverDesc solver = {};
    std::optional<AirDesc> air = {};      ///< by default a vacuum
    std::vector<SceneCloth> cloths = {};  ///< at least one
    std::vector<SceneCollider> colliders = {};
    std::vector<StitchDesc> stitches = {};
    std::optional<Camera> camera = {};  ///< by default placed so that everything is visible
    Lighting light = {};
    friend bool operator==(const SceneDesc&, const SceneDesc&) = default;
};

}  // namespace weft
