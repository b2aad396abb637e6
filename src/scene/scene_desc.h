// What a scene says, as values in SI units with their defaults. No file format and no simulation lives here. The ranges
// of the values are in scene_keys.h; check.h applies them. The parts that a program may use too are in weft/scene.h.
#pragma once

#include "base/transform.h"
#include "look/camera.h"
#include "look/light.h"
#include "look/material.h"
#include "mesh/procedural.h"
#include "scene/fabric.h"

#include <weft/result.h>
#include <weft/scene.h>

namespace weft {

// weft/scene.h names every wind that there is, in the same order.
#define WEFT_WIND(name, Name) WindKind::name,
inline constexpr WindKind wind_order[] = {
#include "physics/air/winds.def"
};
#undef WEFT_WIND
static_assert([] {
    int number = 0;
    for (const WindKind kind : wind_order)
        if (static_cast<int>(kind) != number++) return false;
    return true;
}());

/// A ClothDesc whose fabric has been looked up.
struct SceneCloth {
    std::string name = {};
    MeshDesc mesh = {};                  ///< what is simulated
    std::optional<MeshDesc> drawn = {};  ///< what is drawn and follows it; without, the same
    TransformDesc transform = {};
    Fabric fabric = {};
    std::string fabric_name = "cotton";  ///< of the preset that the fabric began as
    std::vector<PinDesc> pins = {};
    Tethers tethers = Tethers::automatic;
    float tether_slack = 0;  ///< of the way over the cloth
    friend bool operator==(const SceneCloth&, const SceneCloth&) = default;
};

/// How something in the scene looks.
struct SceneLook {
    std::string object = {};  ///< name of a cloth or a collider
    std::string preset = {};  ///< name of the material whose values stand where none is given
    Material material = {};
    friend bool operator==(const SceneLook&, const SceneLook&) = default;
};

struct SceneDesc {
    std::string name = {};
    Vec3 gravity{0, -9.81f, 0};  ///< m/s²
    float frame_rate = 60;       ///< frames per second, > 0
    SolverDesc solver = {};
    std::optional<AirDesc> air = {};      ///< without, a vacuum
    std::vector<SceneCloth> cloths = {};  ///< at least one
    std::vector<ColliderDesc> colliders = {};
    std::vector<StitchDesc> stitches = {};
    std::optional<Camera> camera = {};  ///< without, one from which everything is seen
    Lighting light = {};
    std::vector<SceneLook> looks = {};  ///< of those that have one
    friend bool operator==(const SceneDesc&, const SceneDesc&) = default;
};

}  // namespace weft
