// Access of the library weft::io to the internals of a Simulation.
#pragma once

#include "look/drawn_solid.h"
#include "look/drawn_surface.h"
#include "scene/scene_desc.h"
#include "weft/backends.h"

#include <weft/export.h>
#include <weft/simulation.h>

#include <filesystem>
#include <span>

namespace weft {

class World;
struct VulkanHost;

/// Checks `world` and returns a scene with these settings and without objects.
Result<SceneDesc> empty_scene(const WorldDesc& world);

/// Exported, because it is used by another library.
struct WEFT_API SimulationAccess {
    /// `scene` must have been checked. Files are searched in `folder`. `where` of errors is a JSON pointer. `make`:
    /// creates the backend; empty: make_backend().
    static Result<Simulation> create(SceneDesc scene, const Options& options, const std::filesystem::path& folder,
                                     const MakeBackend& make = {});
    /// Creates a backend on a host's device. `host` must outlive the returned function.
    static MakeBackend backend_on(const VulkanHost& host);

    static const SceneDesc& scene(const Simulation& simulation);
    static const std::filesystem::path& folder(const Simulation& simulation);
    /// Current surfaces; valid until the next step or change.
    static std::span<const DrawnSurface> surfaces(const Simulation& simulation);
    /// Bodies and, if `colliders`, all other colliders except planes. Valid until the next call, step or change.
    static std::span<const DrawnSolid> solids(const Simulation& simulation, bool colliders);
    static World& world(Simulation& simulation);
    static const World& world(const Simulation& simulation);
};

}  // namespace weft
