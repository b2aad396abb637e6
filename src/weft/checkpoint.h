// A scene and its world at one moment, in memory.
#pragma once

#include "scene/scene_desc.h"
#include "solver/world/world_moment.h"
#include "weft/cloth_building.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace weft {

/// Result of SceneWorld::checkpoint(). Shares models, meshes and shapes with the world.
struct Checkpoint {
    std::shared_ptr<const SceneDesc> scene;
    std::vector<ClothSource> sources;             ///< per cloth
    std::vector<std::uint64_t> collider_serials;  ///< per collider
    WorldMoment moment;
};

/// Bytes of memory that the checkpoint does not share.
std::size_t size_of(const Checkpoint& checkpoint);

}  // namespace weft
