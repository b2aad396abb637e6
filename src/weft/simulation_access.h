// What the library weft::io needs of a Simulation, beside what everyone may use.
#pragma once

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

/// What a world to be filled begins with, once it has been checked.
Result<SceneDesc> empty_scene(const WorldDesc& world);

/// Marked as the public interface is: it lies between two libraries.
struct WEFT_API SimulationAccess {
    /// A scene that has been checked. Files are looked for in `folder`. Problems have JSON pointers as `where`. `make`:
    /// another backend than that of the options.
    static Result<Simulation> create(SceneDesc scene, const Options& options, const std::filesystem::path& folder,
                                     const MakeBackend& make = {});
    /// Of the backend on a host's device. `host` must stay while it is used.
    static MakeBackend backend_on(const VulkanHost& host);

    static const SceneDesc& scene(const Simulation& simulation);
    static const std::filesystem::path& folder(const Simulation& simulation);
    /// As they are now; valid until the next step or change.
    static std::span<const DrawnSurface> surfaces(const Simulation& simulation);
    static World& world(Simulation& simulation);
    static const World& world(const Simulation& simulation);
};

}  // namespace weft
